// section: 12.6
// value: r1.r7[3] = 3, r2.r6[2] = 2, r2.r0 = 1, r3.r6[5] = 5, r3.r5 = 5
package Demo
  record Record1
    parameter Real r0 = 0;
  end Record1;
  record Record2
    extends Record1;
    final constant Real c1 = 2.0;
    constant Real c2;
    parameter Integer n1 = 5;
    parameter Integer n2;
    parameter Real r1 "comment";
    parameter Real r2 = sin(c1);
    final parameter Real r3 = cos(r2);
    Real r4;
    Real r5 = 5.0;
    Real r6[n1];
    Real r7[n2];
  end Record2;
end Demo;
model RecordConstructorOrder
  Demo.Record2 r1 = Demo.Record2(r0 = 1, c2 = 2, n1 = 2, n2 = 3, r1 = 1, r2 = 2, r4 = 5, r5 = 5, r6 = {1, 2}, r7 = {1, 2, 3});
  Demo.Record2 r2 = Demo.Record2(1, 2, 2, 3, 1, 2, 5, 5, {1, 2}, {1, 2, 3});
  parameter Demo.Record2 r3 = Demo.Record2(c2 = 2, n2 = 1, r1 = 1, r4 = 4, r6 = 1:5, r7 = {1});
end RecordConstructorOrder;
