// section: 9.1.3
// value: use.user.y = 6
model BusThroughModels
  expandable connector Bus
  end Bus;
  connector RealInput = input Real;
  connector RealOutput = output Real;
  block Sensor
    RealOutput speed = 3;
  end Sensor;
  block User
    RealInput speed;
    Real y = 2*speed;
  end User;
  model WithSensor
    Bus bus;
    replaceable Sensor sensor;
  equation
    connect(bus.speed, sensor.speed);
  end WithSensor;
  model WithUser
    Bus bus;
    replaceable User user;
  equation
    connect(bus.speed, user.speed);
  end WithUser;
  WithUser use;
  WithSensor give;
  Bus bus;
equation
  connect(bus, use.bus);
  connect(bus, give.bus);
end BusThroughModels;
