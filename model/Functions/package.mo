within Lacuna;
package Functions "Functions of real arguments used by the components"
end Functions;
