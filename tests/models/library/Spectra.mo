model Spectra
  function spectrum
    input Real u[:];
    output Real A[div(size(u, 1), 2) + 1];
    output Real P[div(size(u, 1), 2) + 1];
  protected
    Integer info;
  algorithm
    (info, A, P) := Modelica.Math.FastFourierTransform.Internal.rawRealFFT(u);
    assert(info == 0, "odd");
  end spectrum;
  Real u12[12] = {3 + 2*cos(i + time) + sin(i^2*time) for i in 1:12};
  Real u30[30] = {cos(i*time) - sin(i^2*time) for i in 1:30};
  Real A12[7], P12[7], A30[16], P30[16];
  parameter Real fixed[4] = spectrum({1, 2, 4, 8, 16, 32});
equation
  (A12, P12) = spectrum(u12);
  (A30, P30) = spectrum(u30);
end Spectra;
