// section: 14.5
// value: s.re = -1, s.im = -2
model OverloadedMinus
  encapsulated package P
  operator record C
    Real re;
    Real im;
    encapsulated operator 'constructor'
      function fromReal
        import OverloadedMinus.P.C;
        input Real re;
        input Real im = 0;
        output C c(re=re, im=im);
      algorithm
      end fromReal;
    end 'constructor';
    encapsulated operator function '+'
      import OverloadedMinus.P.C;
      input C a;
      input C b;
      output C c;
    algorithm
      c := C(a.re + b.re, a.im + b.im);
    end '+';
    encapsulated operator '*'
      import OverloadedMinus.P.C;
      function multiply
        input C a;
        input C b;
        output C c;
      algorithm
        c := C(a.re*b.re - a.im*b.im, a.re*b.im + a.im*b.re);
      end multiply;
    end '*';
    encapsulated operator '-'
      import OverloadedMinus.P.C;
      function negate
        input C a;
        output C c;
      algorithm
        c := C(-a.re, -a.im);
      end negate;
    end '-';
    encapsulated operator function '=='
      import OverloadedMinus.P.C;
      input C a;
      input C b;
      output Boolean same;
    algorithm
      same := a.re == b.re and a.im == b.im;
    end '==';
  end C;
  end P;
  import OverloadedMinus.P.C;
  C a = C(time, 2*time);
  C s = -a;
end OverloadedMinus;
