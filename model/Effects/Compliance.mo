within Lacuna.Effects;
model Compliance "Elasticity between two parts of a shaft that is believed rigid"
  extends Interfaces.SplitInertia;
  parameter Types.RotationalStiffness c(final min=0) = 1 "Stiffness";
  parameter Types.RotationalDamping d(final min=0) = 0 "Damping constant";
  constant Types.AngularVelocity unit_w = 1;
  Types.RotationalStiffness c_unit = J*unit_w*unit_w "Stiffness that makes the whole inertia swing at 1 rad/s";
  Types.RotationalDamping d_unit = J*unit_w "Damping that stops the whole inertia within 1 s";
equation
  tau_b = c*phi_rel + d*w_rel;
  annotation(__Lacuna(effect="compliance", attaches="flange", signals(J="inertia"), nests_in={"backlash"},
    starts(c={300, 900, 2500, 7000, 2e4, 6e4, 2e5}, d={10}, share={0.35}), relative(c="c_unit", d="d_unit"),
    signature="swinging after fast changes of the torque", excitation="steps or fast changes of the torque",
    reference="Vukosavic, Stojic 1998"));
end Compliance;
