"""xorshift generators in C (see flatten/functions/library/random_numbers.py): Integers are doubles of whole value,
words of 32 bits."""

WORDS = """\
static unsigned long long mdl_word(const double *pair) {
  return (unsigned)(int)pair[0] | (unsigned long long)(unsigned)(int)pair[1] << 32;
}

static void mdl_store_word(unsigned long long word, double *pair) {
  pair[0] = (int)(unsigned)word;
  pair[1] = (int)(unsigned)(word >> 32);
}

/* Above 0 and up to 1. */
static double mdl_unit(unsigned long long word) {
  return (double)(long long)word * 0x1p-64 + 0.5;
}"""

NATIVE = {
    "mdl_ModelicaRandom_xorshift64star": """\
static void mdl_ModelicaRandom_xorshift64star(const double *in, double *out, double *y) {
  unsigned long long x = mdl_word(in);
  x ^= x >> 12;
  x ^= x << 25;
  x ^= x >> 27;
  x *= 2685821657736338717u;
  mdl_store_word(x, out);
  *y = mdl_unit(x);
}""",
    "mdl_ModelicaRandom_xorshift128plus": """\
static void mdl_ModelicaRandom_xorshift128plus(const double *in, double *out, double *y) {
  unsigned long long a = mdl_word(in), b = mdl_word(in + 2);
  a ^= a << 23;
  a = (a ^ b ^ (a >> 17) ^ (b >> 26)) + b;
  mdl_store_word(b, out);
  mdl_store_word(a, out + 2);
  *y = mdl_unit(a);
}""",
    "mdl_ModelicaRandom_xorshift1024star": """\
static void mdl_ModelicaRandom_xorshift1024star(const double *in, double *out, double *y) {
  int at = (int)in[32] & 15;
  unsigned long long a = mdl_word(in + 2 * at), b;
  at = (at + 1) & 15;
  b = mdl_word(in + 2 * at);
  b ^= b << 31;
  b ^= b >> 11;
  a ^= a >> 30;
  a ^= b;
  for (int i = 0; i < 32; ++i) out[i] = in[i];
  mdl_store_word(a, out + 2 * at);
  out[32] = at;
  *y = mdl_unit(a * 1181783497276652981u);
}""",
    "mdl_impure_random": """\
/* A number from an instant and the place of a call (see flatten/functions/library/impure.py). */
static void mdl_impure_random(double id, double instant, double call, double *y) {
  unsigned long long x;
  memcpy(&x, &instant, sizeof x);
  const unsigned long long keys[] = {(unsigned long long)(long long)id, (unsigned long long)call};
  for (int i = 0; i < 2; ++i) {
    x += 0x9e3779b97f4a7c15u * (keys[i] + 1);
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    x ^= x >> 31;
  }
  *y = (double)(long long)x * 0x1p-64 + 0.5;
}""",
}  # fmt: skip
