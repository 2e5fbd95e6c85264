// section: 5.3.2
// refuse: R075 10
model ClassInsideAPartialOne "a class inside a partial class"
  partial model A
    constant Real c = 2;
    model B
      Real x = 1;
    end B;
  end A;
  A.B b;
end ClassInsideAPartialOne;
