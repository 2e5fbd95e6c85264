// section: 8.3.5
// value: close = false, close at 0.25 = true
model PriorityByOrder
  Boolean close(start = false, fixed = true);
algorithm
  when time > 0.3 then
    close := false;
  end when;
  when time > 0.2 then
    close := true;
  end when;
end PriorityByOrder;
