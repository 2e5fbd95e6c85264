// section: 7.2.7
// refuse: R078 5
package Parts
  model A
    model Inner
      Real x = 1;
    end Inner;
  end A;
end Parts;
model BindingOfAPartTakenAway "break takes the value of an element of a component away, which then has an equation less"
  extends Parts.A;
  Inner part(x = break);
equation
  part.x = time;
end BindingOfAPartTakenAway;
