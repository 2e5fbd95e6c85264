// section: 14.7
// value: c3.re = 5, c3.im = 7, c4.re = -5, x1[2] = 5, x2[1] = 3, eq = true
operator record C
  Real re;
  Real im;
  encapsulated operator 'constructor'
    import C;
    function fromReal
      input Real re;
      input Real im = 0;
      output C result(re = re, im = im);
    algorithm
      annotation(Inline = true);
    end fromReal;
  end 'constructor';
  encapsulated operator function '+'
    import C;
    input C c1;
    input C c2;
    output C result;
  algorithm
    result := C(c1.re + c2.re, c1.im + c2.im);
  end '+';
  encapsulated operator '-'
    import C;
    function negate
      input C c;
      output C result;
    algorithm
      result := C(-c.re, -c.im);
    end negate;
    function subtract
      input C c1;
      input C c2;
      output C result;
    algorithm
      result := C(c1.re - c2.re, c1.im - c2.im);
    end subtract;
  end '-';
  encapsulated operator function '*'
    import C;
    input C c1;
    input C c2;
    output C result;
  algorithm
    result := C(c1.re*c2.re - c1.im*c2.im, c1.re*c2.im + c1.im*c2.re);
  end '*';
  encapsulated operator function '=='
    import C;
    input C c1;
    input C c2;
    output Boolean result;
  algorithm
    result := c1.re == c2.re and c1.im == c2.im;
  end '==';
  encapsulated operator function '0'
    import C;
    output C c;
  algorithm
    c := C(0, 0);
  end '0';
  encapsulated function j
    import C;
    output C c;
  algorithm
    c := C(0, 1);
  end j;
end C;
model ComplexByHand
  parameter C j = C.j();
  C c1 = 2 + 3*j;
  C c2 = 3 + 4*j;
  C c3 = c1 + c2;
  C c4 = -c1 - c2;
  C v[2] = {C(1, 2), C(2, 3)}*C(1, 1);
  Real x1[2] = v.im;
  Real x2[2] = ({C(1, 2), C(2, 3)}*C(1, 1)).im;
  parameter Boolean eq = C(1, 2) == C(1, 2);
end ComplexByHand;
