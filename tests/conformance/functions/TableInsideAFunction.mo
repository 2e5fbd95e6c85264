// section: 12.4.4
// value: q at 0.1 = 1, q at 0.6 = 0.5, q at 0.9 = -0.5
model TableInsideAFunction "the size of a local array follows from its binding, in a function that runs at run time"
  function pump
    input Real t;
    output Real q;
  protected
    constant Real T[:] = {0, 1, 2, 4, 5};
    constant Real Q[size(T, 1)] = {0, 2, 2, -1, 0};
    Integer i = 1;
  algorithm
    while i < size(T, 1) - 1 and t > T[i + 1] loop
      i := i + 1;
    end while;
    q := Q[i] + (t - T[i])/(T[i + 1] - T[i])*(Q[i + 1] - Q[i]);
  end pump;
  Real q = pump(5*time);
end TableInsideAFunction;
