within Lacuna.Interfaces;
connector RealInput = input Real "Real signal into a block";
