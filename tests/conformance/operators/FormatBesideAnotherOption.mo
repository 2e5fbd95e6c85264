// section: 3.7.1
// refuse: R050 4
model FormatBesideAnotherOption "a format beside another option"
  parameter String s = String(5.0, format="5.2f", minimumLength=4);
end FormatBesideAnotherOption;
