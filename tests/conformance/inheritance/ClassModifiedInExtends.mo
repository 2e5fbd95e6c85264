// section: 7.2
// value: b.x = 4
model ClassModifiedInExtends
  model A
    model B
      Real x = 2;
    end B;
    B b;
  end A;
  extends A(B(x=4));
end ClassModifiedInExtends;
