// section: 7.3
// value: a.d = 1000, b.d = 1.2
model Package
  partial package Fluid
    constant Real rho;
    replaceable partial function density
      input Real T;
      output Real d;
    end density;
  end Fluid;
  package Water
    extends Fluid(rho=1000);
    redeclare function extends density
    algorithm
      d := rho;
    end density;
  end Water;
  package Air
    extends Fluid(rho=1.2);
    redeclare function extends density
    algorithm
      d := rho;
    end density;
  end Air;
  model Pipe
    replaceable package Medium = Fluid;
    Real d = Medium.density(300);
  end Pipe;
  Pipe a(redeclare package Medium = Water), b(redeclare package Medium = Air);
end Package;
