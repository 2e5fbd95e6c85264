// code: P019
// line: 1
// hint: model NAME
// nothing but a comment
