import os

# Simulations run on a thread for each core already; threads of linear algebra beside them cost many times their gain.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
