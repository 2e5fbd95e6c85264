// code: R071
// line: 8
// hint: a model extends record or block or model
package P
  constant Real a = 1;
end P;
model M
  extends P;
end M;
