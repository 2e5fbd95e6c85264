within Lacuna.Components;
package Drives "Brushless machine, inverter and commutation"
end Drives;
