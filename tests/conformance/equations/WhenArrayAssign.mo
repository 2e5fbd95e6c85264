// section: 8.3.5
// value: x[1] = 0.5, x[2] = 1
model WhenArrayAssign "whole arrays at an event"
  discrete Real x[2](each start=0, each fixed=true);
equation
  when time >= 0.5 then
    x = {time, 2*time};
  end when;
end WhenArrayAssign;
