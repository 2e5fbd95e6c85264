// section: 11.2.1.1
// value: line.x[1] = 6, line.x[2] = 5, line.x[3] = 4
model AssignedTogetherInAComponent "A shift register: what carries its values is no unknown of its own"
  model Register
    Integer x[3](each start=0, each fixed=true);
    Integer k(start=1, fixed=true);
  algorithm
    when sample(0.1, 0.2) then
      k := pre(k) + 1;
      x := cat(1, {k}, x[1:end - 1]);
    end when;
  end Register;
  Register line;
end AssignedTogetherInAComponent;
