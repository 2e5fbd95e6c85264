within Lacuna.Components;
package Control "Controllers, filters and regulators, continuous and sampled"
end Control;
