// code: R075
// line: 12
// hint: another name
package P
  constant Real g = 1;
end P;
package Q
  constant Real g = 2;
end Q;
model M
  import P.g;
  import Q.g;
  Real x = g;
end M;
