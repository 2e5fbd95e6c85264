package Lacuna "Electromechanical actuators: components, whole actuators, benches and the effects a model may lack"
  annotation(Documentation(info="<html>
<p>Models of aerospace electromechanical actuators, written in a strict subset of Modelica 3.6. Quantities are in SI
units; symbols and signs are those of the Modelica Standard Library (see <code>UsersGuide</code>).</p>
</html>"));
end Lacuna;
