// section: 12.9.7
// refuse: R094 16
model ExternalObjectOfTheUser
  class Tab
    extends ExternalObject;
    function constructor
      input Real v;
      output Tab t;
      external "C" t = mk(v);
    end constructor;
    function destructor
      input Tab t;
      external "C" rm(t);
    end destructor;
  end Tab;
  Tab t = Tab(3);
end ExternalObjectOfTheUser;
