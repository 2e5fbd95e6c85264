within Lacuna.Interfaces;
partial model ImposedMotion "Device between a test machine that imposes its motion and a load cell"
  RealInput s(unit="m") "Imposed displacement";
  RealInput v(unit="m/s") "Imposed speed";
  RealOutput f(unit="N") "Resisting force, positive against positive speed";
  annotation(Documentation(info="<html>
<p>Use it for devices that are tested by imposing displacement and speed together. A device adds its force law; the
motion is not solved for.</p>
</html>"));
end ImposedMotion;
