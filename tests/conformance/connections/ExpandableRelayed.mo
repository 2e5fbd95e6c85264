// section: 9.1.3
// value: actuator.x = 1.5, controller.t = 2
model ExpandableRelayed
  connector RealInput = input Real;
  connector RealOutput = output Real;
  expandable connector Bus
  end Bus;
  model Sensor
    Bus bus;
  protected
    RealOutput y = 2*time;
  equation
    connect(y, bus.temperature);
  end Sensor;
  model Controller
    Bus bus;
  protected
    RealInput t;
    RealOutput y = 1.5*t;
  equation
    connect(t, bus.temperature);
    connect(y, bus.heat);
  end Controller;
  model Actuator
    Bus bus;
    Real x(start = 0, fixed = true);
  protected
    RealInput u;
  equation
    der(x) = u;
    connect(u, bus.heat);
  end Actuator;
  Actuator actuator;
  Controller controller;
  Sensor sensor;
equation
  connect(controller.bus, actuator.bus);
  connect(sensor.bus, controller.bus);
end ExpandableRelayed;
