// section: 10.6.2
// value: same = true
model TextsAdded
  parameter String a[2] = {"a", "b"} + {"c", "d"};
  parameter Boolean same = a[2] == "bd";
end TextsAdded;
