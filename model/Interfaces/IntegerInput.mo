within Lacuna.Interfaces;
connector IntegerInput = input Integer "Integer signal into a block";
