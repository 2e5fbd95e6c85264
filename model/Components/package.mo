within Lacuna;
package Components "Components, by physical domain"
end Components;
