within Lacuna;
package Degradation "Slow laws: how a fault grows with use, from one pre-flight test to the next"
  annotation(Documentation(info="<html>
<p>One law a file. <code>lacuna forecast</code> reads this folder, and any folder of yours (<code>--laws</code>), so a law is
added by adding a file that extends <code>Interfaces.PartialLaw</code>.</p>
<p>A law has one state, <code>severity</code>, as a share of the limit beyond which the actuator is removed: 0 is a new
part, 1 the limit. The model's <code>time</code> stands for use: one second is one flight cycle, or one hour, whatever the
history counts. What the forecast must know stands in <code>annotation(__Lacuna(...))</code>:</p>
<ul>
<li><code>law</code>: identifier, as forecasts name it.</li>
<li><code>rate</code>: the parameter that <code>der(severity)</code> is proportional to. Its value is unknown over decades,
and found from the history.</li>
<li><code>shapes(p={...})</code>: values at which another unknown parameter is tried, each weighed by the
evidence: so close that what remains of a life differs less between neighbours than the process noise lets it.</li>
<li><code>wander</code>: process noise of the rate, standard deviation of its logarithm over one life.</li>
<li><code>diffusion</code>: process noise of the severity itself, its standard deviation after growth from 0 to 1.</li>
<li><code>reference</code>: where the law is described.</li>
</ul>
</html>"));
end Degradation;
