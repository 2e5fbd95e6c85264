// section: 14.3
// refuse: R079 18
package Numbers
  operator record C
    Real r;
    Real s;
    encapsulated operator function 'constructor'
      import Numbers.C;
      input Real r;
      output C c(r = r, s = 1);
    algorithm
    end 'constructor';
  end C;
end Numbers;
model OnlyItsOwnConstructors
  import Numbers.C;
  C a = C(3);
  C b = C(3, 4);
end OnlyItsOwnConstructors;
