within Lacuna;
package Types "Physical quantities in SI units, and the enumerations of the library"
  type Time = Real(final quantity="Time", final unit="s");
  type Frequency = Real(final quantity="Frequency", final unit="Hz");
  type Angle = Real(final quantity="Angle", final unit="rad");
  type AngularVelocity = Real(final quantity="AngularVelocity", final unit="rad/s");
  type AngularAcceleration = Real(final quantity="AngularAcceleration", final unit="rad/s2");
  type Length = Real(final quantity="Length", final unit="m");
  type Velocity = Real(final quantity="Velocity", final unit="m/s");
  type Acceleration = Real(final quantity="Acceleration", final unit="m/s2");
  type Mass = Real(final quantity="Mass", final unit="kg");
  type Inertia = Real(final quantity="MomentOfInertia", final unit="kg.m2");
  type Force = Real(final quantity="Force", final unit="N");
  type Torque = Real(final quantity="Torque", final unit="N.m");
  type Stiffness = Real(final quantity="TranslationalSpringConstant", final unit="N/m");
  type Damping = Real(final quantity="TranslationalDampingConstant", final unit="N.s/m");
  type RotationalStiffness = Real(final quantity="RotationalSpringConstant", final unit="N.m/rad");
  type RotationalDamping = Real(final quantity="RotationalDampingConstant", final unit="N.m.s/rad");
  type ContactDamping = Real(final quantity="ContactDamping", final unit="s/rad")
    "Loss factor of a Hunt-Crossley contact";
  type Lead = Real(final quantity="Lead", final unit="m/rad") "Travel of a screw for one radian";
  type Voltage = Real(final quantity="ElectricPotential", final unit="V");
  type Current = Real(final quantity="ElectricCurrent", final unit="A");
  type CurrentSlope = Real(final quantity="CurrentSlope", final unit="A/s");
  type Resistance = Real(final quantity="Resistance", final unit="Ohm");
  type Inductance = Real(final quantity="Inductance", final unit="H");
  type Capacitance = Real(final quantity="Capacitance", final unit="F");
  type BackEmfConstant = Real(final quantity="ElectricalTorqueConstant", final unit="V.s/rad")
    "Also the torque constant: 1 V.s/rad = 1 N.m/A";
  type Power = Real(final quantity="Power", final unit="W");
  type Energy = Real(final quantity="Energy", final unit="J");
  type Temperature = Real(final quantity="ThermodynamicTemperature", final unit="K", min=0);
  type RateOfUse = Real(final quantity="RateOfUse", final unit="1/s")
    "For each unit of use, which is the unit of time of a degradation law: a flight cycle or an hour";
  type PerUnit = Real(final unit="1") "Ratio of two like quantities";
  type Eccentricity = enumeration(
    RotorAngle "One modulation with the rotor's electrical angle, common to the three phases",
    StatorFixed "Each phase sees its own constant air gap") "How static eccentricity acts on the back-EMF";
  annotation(Documentation(info="<html>
<p>Every variable and parameter of the library has one of these types, so that the dimensions of each equation can be
checked. The radian counts as dimensionless in that check: <code>V.s/rad</code> and <code>N.m/A</code> agree.</p>
</html>"));
end Types;
