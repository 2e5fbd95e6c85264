within Lacuna;
package Benches "Small reference machines, as recorded on laboratory benches"
end Benches;
