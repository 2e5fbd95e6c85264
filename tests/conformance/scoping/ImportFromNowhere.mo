// section: 13.2.1
// refuse: R002 4
model ImportFromNowhere
  import Nope.p;
  Real y = 1;
end ImportFromNowhere;
