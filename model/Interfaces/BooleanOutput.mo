within Lacuna.Interfaces;
connector BooleanOutput = output Boolean "Boolean signal out of a block";
