// section: 10.6.2
// value: s[1].re = 5, s[2].im = 24, t.re = -5, t.im = 28
package Numbers
  operator record C
    Real re;
    Real im;
    encapsulated operator '*'
      import Numbers.C;
      function multiply
        input C a;
        input C b;
        output C c = C(a.re*b.re - a.im*b.im, a.re*b.im + a.im*b.re);
      algorithm
      end multiply;
      function scalarProduct
        input C a[:];
        input C b[size(a, 1)];
        output C c = C(sum(a[k].re*b[k].re - a[k].im*b[k].im for k in 1:size(a, 1)), sum(a[k].re*b[k].im + a[k].im*b[k].re for k in 1:size(a, 1)));
      algorithm
      end scalarProduct;
    end '*';
  end C;
end Numbers;
model ElementsOfRecords
  Numbers.C a[2] = {Numbers.C(1, 0), Numbers.C(2, 3)};
  Numbers.C b[2] = {Numbers.C(5, 4), Numbers.C(4, 6)};
  Numbers.C s[2] = a .* b;
  Numbers.C t = a*b;
end ElementsOfRecords;
