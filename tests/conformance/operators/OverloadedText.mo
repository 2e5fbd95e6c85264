// section: 14.4
// refuse: R020 56
model OverloadedText
  encapsulated package P
  operator record C
    Real re;
    Real im;
    encapsulated operator 'constructor'
      function fromReal
        import OverloadedText.P.C;
        input Real re;
        input Real im = 0;
        output C c(re=re, im=im);
      algorithm
      end fromReal;
    end 'constructor';
    encapsulated operator function '+'
      import OverloadedText.P.C;
      input C a;
      input C b;
      output C c;
    algorithm
      c := C(a.re + b.re, a.im + b.im);
    end '+';
    encapsulated operator '*'
      import OverloadedText.P.C;
      function multiply
        input C a;
        input C b;
        output C c;
      algorithm
        c := C(a.re*b.re - a.im*b.im, a.re*b.im + a.im*b.re);
      end multiply;
    end '*';
    encapsulated operator '-'
      import OverloadedText.P.C;
      function negate
        input C a;
        output C c;
      algorithm
        c := C(-a.re, -a.im);
      end negate;
    end '-';
    encapsulated operator function '=='
      import OverloadedText.P.C;
      input C a;
      input C b;
      output Boolean same;
    algorithm
      same := a.re == b.re and a.im == b.im;
    end '==';
  end C;
  end P;
  import OverloadedText.P.C;
  parameter C a = C(1, 2);
  Boolean s = String(a) == "1";
end OverloadedText;
