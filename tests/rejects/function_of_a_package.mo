// code: R004
// line: 13
// hint: did you mean h
package M
  function h
    input Real T;
    output Real y = 2*T;
  algorithm
  end h;
end M;

model N
  Real x = M.hh(time);
end N;
