within Lacuna.Components;
package Electrical "Sources, passive elements and ideal diodes"
end Electrical;
