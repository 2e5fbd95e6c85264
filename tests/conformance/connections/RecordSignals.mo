// section: 9.3.1
// value: sink.a = 1, sink.b = 2
model RecordSignals
  record Pair
    Real re;
    Real im;
  end Pair;
  connector PairOutput = output Pair;
  connector PairInput = input Pair;
  connector Measured = PairOutput;
  block Source
    Measured y;
  equation
    y.re = time;
    y.im = 2;
  end Source;
  block Sink
    PairInput u;
    Real a = u.re;
    Real b = u.im;
  end Sink;
  Source source;
  Sink sink;
equation
  connect(source.y, sink.u);
end RecordSignals;
