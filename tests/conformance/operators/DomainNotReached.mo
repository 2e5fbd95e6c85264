// section: 3.7.3
// value: y = 1
model DomainNotReached
  parameter Boolean wanted = false;
  Real y = if wanted then log(-1) else 1;
end DomainNotReached;
