// section: 5.4
// value: s.pipe.y = 92, s.pipe.z = 870, s.pipe.leg.z = 870, t.pipe.y = 14, t.pipe.z = 700
package Fluids
  partial package Fluid
    constant Real rho = 1000;
    replaceable partial function viscosity
      input Real T;
      output Real nu;
    end viscosity;
  end Fluid;
  package Oil
    extends Fluid(rho = 870);
    redeclare function extends viscosity
    algorithm
      nu := 46*T;
    end viscosity;
  end Oil;
  package Spirit
    extends Fluid(rho = 700);
    redeclare function extends viscosity
    algorithm
      nu := 7*T;
    end viscosity;
  end Spirit;
  partial model OfFluid
    outer package Medium = Fluid;
  end OfFluid;
  model Leg
    extends OfFluid;
    Real z = Medium.rho;
  end Leg;
  model Pipe
    outer package Medium = Fluid;
    Leg leg;
    Real y = Medium.viscosity(2), z = Medium.rho;
  end Pipe;
  model Plant
    inner replaceable package Medium = Oil constrainedby Fluid;
    Pipe pipe;
  end Plant;
end Fluids;
model InnerPackage
  Fluids.Plant s, t(redeclare package Medium = Fluids.Spirit);
end InnerPackage;
