within Lacuna;
package Effects "Physics that a model may lack: each a component that discovery attaches to a believed model"
  annotation(Documentation(info="<html>
<p>One effect a file. Discovery reads this folder, so an effect is added by adding a file. What it must know stands in
<code>annotation(__Lacuna(...))</code>:</p>
<ul>
<li><code>effect</code>: identifier of the physics, as diagnoses name it.</li>
<li><code>attaches</code>: <code>flange</code> (a connector <code>flange</code> joined to a shaft), <code>series</code> (pins
<code>p</code>, <code>n</code> put into a line), <code>phases</code> (the same, in every phase with equal parameters),
<code>signal</code> (<code>u</code>, <code>y</code> put into a signal that drives the model), <code>sensor</code> (<code>u</code>,
<code>y</code> after a recorded variable) or <code>replace</code> (takes the place of a component of class
<code>replaces</code>, which it extends).</li>
<li><code>neutral(p=value)</code>: value of the parameter at which the effect vanishes, if there is one.</li>
<li><code>starts(p={...})</code>: values from which a fit starts; <code>relative(p=\"x\")</code>: in units of the greatest
value that variable <code>x</code> of the component takes; <code>whole={\"p\"}</code>: whole numbers, scanned and kept.</li>
<li><code>nests_in</code>: identifiers of richer laws that contain this one.</li>
<li><code>signature</code>, <code>excitation</code>, <code>reference</code>: what it leaves, what must be done to see it,
where it is described.</li>
</ul>
</html>"));
end Effects;
