// section: 12.9
// value: x[1] = 1, x[2] = 2, info = 0, y[1] = 1.5, y[2] = 1, d = 0.2, s = 1
package Lapack
  function dgesv_vec
    input Real A[:, size(A, 1)];
    input Real b[size(A, 1)];
    output Real x[size(A, 1)] = b;
    output Integer info;
  protected
    Integer n = size(A, 1);
    Integer nrhs = 1;
    Real Awork[size(A, 1), size(A, 1)] = A;
    Integer lda = max(1, size(A, 1));
    Integer ldb = max(1, size(b, 1));
    Integer ipiv[size(A, 1)];
  external "FORTRAN 77" dgesv(n, nrhs, Awork, lda, ipiv, x, ldb, info) annotation(Library="lapack");
  end dgesv_vec;
end Lapack;
model LinearEquationsOfLapack "A*x = b by LAPACK's dgesv, as the standard library declares it: with a pivot that moves"
  Real x[2], y[2];
  Integer info, s;
  Real d = der(y[1]);
equation
  (x, info) = Lapack.dgesv_vec([0, 1; 3, 4], {2, 11});
  (y, ) = Lapack.dgesv_vec([1 + time, 2; -1, 4*time], {5, 2.5});
  (, s) = Lapack.dgesv_vec([0, 2; 0, 1], {1, 1});
end LinearEquationsOfLapack;
