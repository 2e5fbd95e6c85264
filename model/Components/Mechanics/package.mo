within Lacuna.Components;
package Mechanics "Inertias, elasticity, friction, play, stops and transmissions"
end Mechanics;
