// section: 14.4
// value: m.n = 1
package P13
  operator record C
    Integer a;
    encapsulated operator function 'String'
      import P13.C;
      input C c;
      output String s = " ";
    algorithm
      s := String(c.a);
    end 'String';
  end C;
  model M
    C c = C(1);
    Boolean b = String(c) == "1";
    Integer n = if b then 1 else 0;
  end M;
end P13;
model TextByOperator
  P13.M m;
end TextByOperator;
