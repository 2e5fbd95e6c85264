within Lacuna.Effects;
package Interfaces "Partial models that effects extend"
end Interfaces;
