within Lacuna;
package Interfaces "Connectors and partial models"
end Interfaces;
