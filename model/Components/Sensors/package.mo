within Lacuna.Components;
package Sensors "Position, current and energy measurement with their errors"
end Sensors;
