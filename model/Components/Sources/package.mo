within Lacuna.Components;
package Sources "Command signals"
end Sources;
