// section: 13.2.1
// refuse: R002 7
package P
  constant Real p = 2;
end P;
model ImportOfNothing
  import P.q;
  Real y = 1;
end ImportOfNothing;
