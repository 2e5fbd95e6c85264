// section: 14.4
// value: s.re = 3, s.im = 1, t.re = 3
model OverloadedWithReal
  encapsulated package P
  operator record C
    Real re;
    Real im;
    encapsulated operator 'constructor'
      function fromReal
        import OverloadedWithReal.P.C;
        input Real re;
        input Real im = 0;
        output C c(re=re, im=im);
      algorithm
      end fromReal;
    end 'constructor';
    encapsulated operator function '+'
      import OverloadedWithReal.P.C;
      input C a;
      input C b;
      output C c;
    algorithm
      c := C(a.re + b.re, a.im + b.im);
    end '+';
    encapsulated operator '*'
      import OverloadedWithReal.P.C;
      function multiply
        input C a;
        input C b;
        output C c;
      algorithm
        c := C(a.re*b.re - a.im*b.im, a.re*b.im + a.im*b.re);
      end multiply;
    end '*';
    encapsulated operator '-'
      import OverloadedWithReal.P.C;
      function negate
        input C a;
        output C c;
      algorithm
        c := C(-a.re, -a.im);
      end negate;
    end '-';
    encapsulated operator function '=='
      import OverloadedWithReal.P.C;
      input C a;
      input C b;
      output Boolean same;
    algorithm
      same := a.re == b.re and a.im == b.im;
    end '==';
  end C;
  end P;
  import OverloadedWithReal.P.C;
  C a = C(time, time);
  C s = a + 2;
  C t = 2 + a;
end OverloadedWithReal;
