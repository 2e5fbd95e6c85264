// section: 12.6
// value: x = 2, blue = 1, s[1].t = 1, s[2].t = 2, s[3].t = 3, named[1] = 1, named[2] = 2, named[3] = 3, c = 2
model TextsOfRecordsUnderAnIf "Fields of type String, and arrays of them, go with the records that a condition moves"
  record Y
    Real t;
    String name = "raw";
    String marks[2] = {"a", "b"};
  end Y;
  function firstBySecond
    input Y y[:];
    input Boolean b;
    output Y z[size(y, 1)] = y;
  algorithm
    if b then
      z[1] := y[2];
    end if;
  end firstBySecond;
  function sorted
    input Y y[:];
    output Y z[size(y, 1)] = y;
  protected
    Y h;
  algorithm
    for i in 1:size(y, 1) loop
      for j in i + 1:size(y, 1) loop
        if z[j].t < z[i].t then
          h := z[i];
          z[i] := z[j];
          z[j] := h;
        end if;
      end for;
    end for;
  end sorted;
  parameter Boolean b = true;
  parameter Y p[2] = firstBySecond({Y(1), Y(2, "blue")}, b);
  Real x = p[1].t*time;
  Real blue = if p[1].name == "blue" then 1 else 0;
  parameter Real last = 3;
  parameter Y s[3] = sorted({Y(last, "three"), Y(2, "two", {"c", "d"}), Y(1)});
  Real named[3] = {if r.name == "three" then 3 elseif r.name == "two" then 2 elseif r.name == "raw" then 1 else 0 for r in s};
  Real c = if s[1].marks[1] == "c" then 1 elseif s[2].marks[1] == "c" then 2 else 3;
end TextsOfRecordsUnderAnIf;
