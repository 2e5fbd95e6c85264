within Lacuna.Interfaces;
connector RealOutput = output Real "Real signal out of a block";
