within Lacuna;
package Effects "Physics that a model may lack: each a component that discovery attaches to a believed model"
  annotation(Documentation(info="<html>
<p>One effect a file. Discovery reads this folder, so an effect is added by adding a file. What it must know stands in
<code>annotation(__Lacuna(...))</code>:</p>
<ul>
<li><code>effect</code>: identifier of the physics, as diagnoses name it.</li>
<li><code>attaches</code>: <code>flange</code> (a connector <code>flange</code> joined to a shaft), <code>line</code> (pins
<code>p</code>, <code>n</code> put into the only line to a machine), <code>star</code> (the same, in every phase of a machine of
several), <code>phases</code> (either), <code>phase</code> (in one phase of several), <code>imposed</code> (a force <code>f</code>
beside a device that is moved), <code>sensor</code> (<code>u</code>, <code>y</code> after a recorded variable) or
<code>replace</code> (takes the place of a component of class <code>replaces</code>, whose connectors and parameters it
has).</li>
<li><code>signals(u=\"motor\")</code>: what drives an input of the effect: the torque of the <code>motor</code>, the
<code>transmitted</code> torque, the <code>inertia</code> of the shaft; of a sensor each other <code>recorded</code>
output of its unit, or each recorded variable of the quantity of the unit that is named; <code>summed(x=\"y\")</code>: input
<code>x</code> takes the sum of variable <code>y</code> over the phases.</li>
<li><code>neutral(p=value)</code>: value of the parameter at which the effect vanishes, if there is one.</li>
<li><code>starts(p={...})</code>: values from which a fit starts; <code>relative(p=\"x\")</code>: in units of the greatest
value that variable <code>x</code> of the component takes (on their own side of zero, where they begin on both); of a
time, <code>relative(p=\"interval\")</code> is the samples' interval, <code>relative(p=\"duration\")</code> a recording's length;
<code>whole={\"p\"}</code>: whole numbers, scanned and kept.</li>
<li><code>polar={\"a\", \"phi\"}</code>: amplitude and phase of one wave; <code>fixed={\"p\"}</code>: not fitted;
<code>variants(p={...})</code>: values written into the model, one hypothesis each.</li>
<li><code>unit</code>: of the signals to which the error of a sensor may belong; <code>twin</code>: the effect of a device that
gives the same error in its recorded force.</li>
<li><code>nests_in</code>: identifiers of richer laws that contain this one.</li>
<li><code>signature</code>, <code>excitation</code>, <code>reference</code>: what it leaves, what must be done to see it,
where it is described.</li>
</ul>
</html>"));
end Effects;
