"""Random numbers of Modelica.Math.Random: xorshift generators on whole numbers of 32 bits.

Marsaglia, J. Stat. Softw. 8 (2003) 14; Vigna, ACM Trans. Math. Softw. 42 (2016) 30 (xorshift64*, xorshift1024*) and
J. Comput. Appl. Math. 315 (2017) 175-181 (xorshift128+). Two words make one number of 64 bits, the lower first; it
becomes a Real above 0 and up to 1 as int64/2^64 + 1/2 (Doornik, ACM Trans. Model. Comput. Simul. 17 (2007) 3).
As in the library, xorshift64* and xorshift128+ keep the number that they give, not that before the last operation.
The same in C is in emit/functions/random_numbers.py, for states that are not known at translation.
"""

from __future__ import annotations

from collections.abc import Callable

_MASK = (1 << 64) - 1


def _joined(words: list[int]) -> list[int]:
    return [(a & 0xFFFFFFFF) | (b & 0xFFFFFFFF) << 32 for a, b in zip(words[::2], words[1::2], strict=True)]


def _divided(numbers: list[int]) -> list[int]:
    return [_signed(half, 32) for n in numbers for half in (n & 0xFFFFFFFF, n >> 32)]


def _signed(n: int, bits: int) -> int:
    return n - (1 << bits) if n >> (bits - 1) else n


def _real(n: int) -> float:
    return _signed(n, 64) * 2.0**-64 + 0.5


def xorshift64star(state: list[int]) -> tuple[list[int], float]:
    (x,) = _joined(state)
    x ^= x >> 12
    x = (x ^ x << 25) & _MASK
    x ^= x >> 27
    x = x * 2685821657736338717 & _MASK
    return _divided([x]), _real(x)


def xorshift128plus(state: list[int]) -> tuple[list[int], float]:
    a, b = _joined(state)
    a = (a ^ a << 23) & _MASK
    a = (a ^ b ^ (a >> 17) ^ (b >> 26)) + b & _MASK
    return _divided([b, a]), _real(a)


def xorshift1024star(state: list[int]) -> tuple[list[int], float]:
    s, at = _joined(state[:32]), state[32] & 15
    a, at = s[at], (at + 1) & 15
    b = s[at]
    b = (b ^ b << 31) & _MASK
    b ^= b >> 11
    a ^= a >> 30
    s[at] = a ^ b
    return [*_divided(s), at], _real(s[at] * 1181783497276652981 & _MASK)


Generator = Callable[[list[int]], tuple[list[int], float]]
WORDS = {"xorshift64star": 2, "xorshift128plus": 4, "xorshift1024star": 33}
GENERATORS: dict[str, Generator] = {
    "ModelicaRandom_xorshift64star": xorshift64star, "ModelicaRandom_xorshift128plus": xorshift128plus,
    "ModelicaRandom_xorshift1024star": xorshift1024star,
}  # fmt: skip
