// section: 14.4
// value: s[1].re = 4, s[2].im = 6
model OverloadedArray
  encapsulated package P
  operator record C
    Real re;
    Real im;
    encapsulated operator 'constructor'
      function fromReal
        import OverloadedArray.P.C;
        input Real re;
        input Real im = 0;
        output C c(re=re, im=im);
      algorithm
      end fromReal;
    end 'constructor';
    encapsulated operator function '+'
      import OverloadedArray.P.C;
      input C a;
      input C b;
      output C c;
    algorithm
      c := C(a.re + b.re, a.im + b.im);
    end '+';
    encapsulated operator '*'
      import OverloadedArray.P.C;
      function multiply
        input C a;
        input C b;
        output C c;
      algorithm
        c := C(a.re*b.re - a.im*b.im, a.re*b.im + a.im*b.re);
      end multiply;
    end '*';
    encapsulated operator '-'
      import OverloadedArray.P.C;
      function negate
        input C a;
        output C c;
      algorithm
        c := C(-a.re, -a.im);
      end negate;
    end '-';
    encapsulated operator function '=='
      import OverloadedArray.P.C;
      input C a;
      input C b;
      output Boolean same;
    algorithm
      same := a.re == b.re and a.im == b.im;
    end '==';
  end C;
  end P;
  import OverloadedArray.P.C;
  C a[2] = {C(1, 2), C(3, 4)}, b[2] = {C(3), C(1, 2)};
  C s[2] = a + b;
end OverloadedArray;
