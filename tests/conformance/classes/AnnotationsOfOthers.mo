// section: 18.4
// value: x = 1
model AnnotationsOfOthers
  Real x = 1 annotation(Evaluate=false, HideResult=true, Foo(bar=1));
  annotation(version="1", uses(Modelica(version="4.0.0")), __Vendor(a=1));
end AnnotationsOfOthers;
