// section: A.2.2
// refuse: P021 3
partial encapsulated model PartialBeforeEncapsulated
end PartialBeforeEncapsulated;
