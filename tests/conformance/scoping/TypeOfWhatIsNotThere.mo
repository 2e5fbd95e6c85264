// section: 4.4.5
// refuse: R001 5
model TypeOfWhatIsNotThere "a component that is not there is of a class that there is"
  parameter Boolean detailed = false;
  Nothing x if detailed;
end TypeOfWhatIsNotThere;
