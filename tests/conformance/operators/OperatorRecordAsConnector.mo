// section: 14.4
// value: g.y.re = 3, g.y.im = 4, g.z.im = 2
package Plane
  operator record P
    Real re;
    Real im;
    encapsulated operator 'constructor'
      function fromReal
        import Plane.P;
        input Real re;
        input Real im = 0;
        output P p(re = re, im = im);
      algorithm
      end fromReal;
    end 'constructor';
    encapsulated operator function '*'
      import Plane.P;
      input P a;
      input P b;
      output P c;
    algorithm
      c := P(a.re*b.re - a.im*b.im, a.re*b.im + a.im*b.re);
    end '*';
  end P;
  operator record Named = P(re(nominal = 2));
  connector In = input Named;
  connector Out = output P;
  block Square
    In u;
    Out y = u*u;
    P z = 2*u;
  end Square;
end Plane;
model OperatorRecordAsConnector "An operator record keeps its operators under the name of a connector"
  Plane.Square g;
equation
  g.u = Plane.Named(2, time);
end OperatorRecordAsConnector;
