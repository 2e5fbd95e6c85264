within Lacuna.Effects;
package Interfaces "What effects extend, and the tracker that looks for their place"
end Interfaces;
