// section: 10.3.4.1
// value: s at 0.4 = 3, s = 6, p = 24, least = -3, all = true, w[1] = 9, w[2] = 12, nested = 25, part = 8, none = 0
// value: x = 2, rate = 5, first = 3, held = 14
model SumOverAVaryingRange "reductions, the range of which follows an argument"
  record Pair
    Real a, b[3];
  end Pair;
  function f
    input Real z[:], A[:, 2];
    input Integer n;
    output Real s = sum(z[j] for j in 1:n);
    output Real p = product(A[i, j] for i in 1:n - 1, j in {1, 2});
    output Real least = min(-z[j] for j in n:-1:1);
    output Boolean all = min(z[j] > 0 for j in 1:n);
    output Real w[2] = sum(A[i, :] for i in 1:n);
    output Real nested = sum(sum(i*j for j in 1:i) for i in 1:n);
    output Real part = sum(z[n:end]) + max(A[n - 1:n, 1]) - 4;
    output Real none = sum(z[j] for j in n:1);
  algorithm
    assert(n < 5, "n is too large");
  end f;
  function powers "with a derivative, and a field of records"
    input Real x;
    input Pair q[2];
    input Integer n;
    output Real y = sum(q[1].b[j]*x^j for j in 1:n) + q[2].a;
  end powers;
  function fields "of a part of an array of records"
    input Pair q[:];
    input Integer n;
    output Real y = sum(q[1:n].a) + max(q[n].b[n - 1:end]);
  algorithm
    assert(n > 1, "n is too small");
  end fields;
  function count "in the condition of a loop"
    input Real z[:];
    output Real n;
  protected
    Integer k = 1;
  algorithm
    while sum(z[j] for j in 1:k) < 5 loop
      k := k + 1;
    end while;
    n := k;
  end count;
  Integer k = 2 + integer(1.0001*time);
  Real s, p, least, w[2], nested, part, none;
  Boolean all;
  Pair q[2] = {Pair(0, {1, 2, 3}), Pair(1, {0, 0, 0})};
  Real x(start=1), rate = der(powers(time, q, if k > 2 then 2 else 1)), first = count({1, 2*time, 9});
  Real held = fields({Pair(1, {1, 2, 3}), Pair(2, {4, 5, 6}), Pair(3, {7, 8, 5*time})}, k);
equation
  (s, p, least, all, w, nested, part, none) = f({1, 2, 3, 4}, [1, 2; 3, 4; 5, 6], k);
  powers(x, q, k) = if k == 3 then 35 else 11;
end SumOverAVaryingRange;
