// section: 13.2.1.1
// refuse: R075 8
package Source
  model A
    constant Real c = 1;
  end A;
end Source;
model ImportFromAModel import Source.A.c;
  Real x = c;
end ImportFromAModel;
