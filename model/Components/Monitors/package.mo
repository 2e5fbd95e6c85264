within Lacuna.Components;
package Monitors "Supervision with confirmation times"
end Monitors;
