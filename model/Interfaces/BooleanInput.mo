within Lacuna.Interfaces;
connector BooleanInput = input Boolean "Boolean signal into a block";
