within Lacuna;
package Actuators "Whole actuators"
end Actuators;
