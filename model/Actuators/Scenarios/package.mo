within Lacuna.Actuators;
package Scenarios "Variants of the flight control actuator with commands, loads and faults"
end Scenarios;
