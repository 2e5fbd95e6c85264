within Lacuna.Interfaces;
connector IntegerOutput = output Integer "Integer signal out of a block";
