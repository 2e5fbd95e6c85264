// section: 12.1.2
// value: y = 3
model ReturnInside
  function first
    input Real v[:];
    input Real limit;
    output Integer at;
  algorithm
    for i in 1:size(v, 1) loop
      at := i;
      if v[i] > limit then
        return;
      end if;
    end for;
  end first;
  Integer y = first({1, 2, 5, 9}, 3);
end ReturnInside;
