// section: 4.5
// refuse: R010 11
model NamedAsAnInheritedClass "two public and equal names of a component and an inherited class"
  model B
    model X
      Real y = 1;
    end X;
  end B;
  model A
    extends B;
    Real X = 1;
  end A;
  A a;
end NamedAsAnInheritedClass;
