"""Writes python_expressions.tsv: expressions and what Python 3.11 makes of them.

Run it with Python 3.11: `python3 python_expressions.py > python_expressions.tsv`. Each line holds an expression and
either `=` and its `str()` or `!` and the exception it raises, in which backslashes, tabs and line breaks are escaped.
Expressions whose integers pass 128 bits, which Periplus refuses, are left out.
"""

import ast
import builtins
import math
import random
import sys
import warnings

NAMES = {name: value for name, value in vars(math).items() if not name.startswith("_")}
NAMES |= {"true": True, "false": False, "__builtins__": builtins}

HAND_PICKED = r"""
1+2
1 + 2 * 3 - 4 / 5
7 // 2, -7 // 2, 7 // -2, -7 // -2
7 % 3, -7 % 3, 7 % -3, -7 % -3
7.5 // 2, -7.5 // 2, 7.5 // -2, 7.5 % -2, -7.5 % 2
-0.0 % 3, 0.0 // -2, -0.0 // 5, 5 % inf, -5 % inf, 5 // -inf
1e308 * 10, -1e308 * 10
0.1 + 0.2, 0.1 * 3, 1/3, 2/3, 10/2
1e16, 1e15, 123456789012345678.0, 1e-4, 1e-5, 0.00012345, 1.5e300, 5e-324
2**10, 2**-1, 2**0.5, (-8)**2, -8**2, (-2)**-3, 0**0, 0.0**0, 2**100, 1**1000000, (-1)**1000001
0**-1
0.0**-1
10.0**400
2.5 ** 3
True + True, True * 3, -True, ~True, not True, True / 2
True & False, True | False, True ^ True, True & 1, 5 & 3, 5 | 3, 5 ^ 3, ~5, 1 << 10, -1 >> 3, 1024 >> 3
1 << -1
1.5 & 2
1 < 2 < 3, 1 < 3 < 2, 3 > 2 >= 2 != 1, 1 == 1.0 == True
(1 < 2) < 3, (1 < 2) == True
2**53 == 2.0**53, 2**53 + 1 == 2.0**53, 2**53 + 1 > 2.0**53, 10**30 < 1e30, 1e30 == 10**30
nan == nan, nan != nan, inf > 10**30, -inf < -10**30, nan < 1, 1 < nan
'a' < 'b', 'abc' < 'abd', 'Z' < 'a', '' < 'a', [1, 2] < [1, 3], (1,) < (1, 2), [1] == [1.0]
1 < 'a'
[1] < (1,)
None < None
1 == 'a', None == 0, [] == (), {} == {}, {'a': 1} == {'a': 1.0}, 'a' == 'a'
1 in [1, 2], 3 not in [1, 2], 'b' in 'abc', 'd' not in 'abc', 'a' in {'a': 1}, 2 in (1, 2), 5 in range(10), 1.0 in [1]
1 in 'abc'
1 in 5
None is None, None is not None, True is True, 1 is not None
1 and 2, 0 and 2, 0 or 3, '' or 'x', 1 or 1/0, 0 and 1/0, not 0, not [], not 'a'
[] and 1, None or [] or 0, 'a' and 'b' and 'c'
1 if True else 2, 1 if 0 else 2, 1 if 0 else 2 if 0 else 3
1/0
1.0/0
1//0
1%0
1.0 % 0
divmod(1, 0)
0x1f, 0o17, 0b101, 1_000_000, 0xFF_FF, 1_0.5_0, 1e1_0, .5, 5., 0e0, 00
012
1__0
1_
'a' 'b' "c", 'a' + 'b', 'ab' * 3, 3 * 'ab', 'a' * 0, 'a' * -1, 'a' * True
'a' + 1
'a' - 'b'
1 + None
[1] + [2], (1,) + (2,), [0] * 3, 2 * (1, 2), [1] * -1
[1] + (2,)
'abc'[0], 'abc'[-1], 'abc'[1:], 'abc'[:-1], 'abc'[::-1], 'abc'[::2], 'abc'[5:], 'abc'[-5:2], 'hello'[-2:-4:-1], 'abc'[None:2]
'abc'[3]
'abc'['a']
'abc'[1.0]
'abc'[::0]
[1, 2, 3][0], [1, 2, 3][-1], [1, 2, 3][1:], [1, 2, 3][::-1], (1, 2, 3)[::2], [1, 2, 3][10:], [1,2,3][True]
[1, 2, 3][3]
[1][-2]
{'a': 1}['a'], {1: 'x'}[1.0], {True: 'y'}[1], {(1, 2): 3}[1, 2]
{'a': 1}['b']
{[1]: 2}
range(10)[3], range(10)[-1], range(0, 10, 3)[2], list(range(10)[2:5]), range(10)[::2], range(10)[::-1], range(5, 0, -2)[1:]
range(5), range(1, 5), range(1, 10, 2), range(5, 0, -1), list(range(5, 0, -1)), len(range(0, 10, 3)), len(range(5, 5)), range(0) == range(5, 5)
range(1, 2, 0)
range(1.5)
1.0, 1.5, -0.0, 100000.0, 1e22, 1e21, 123456.789, 1e100, inf, -inf, nan
[1, 'a', 1.0, None, True, (1,), (), [], {}, {'a': [1]}, set()]
'it\'s', "say \"hi\"", ['it\'s'], ["say \"hi\""], ['both \' and "'], ['\\'], ['\n\t\r'], ['\x00\x7f'], ['é ü 漢'], ['\u200b'], ['\xa0']
'\x41\u0042\103\q\
z'
r'\n', R"\d", u'x', 'x' == u'x'
'''triple 'quoted' string''', '''a
b'''
f'{1}', f'{1+1}a{"b"}', f'{{}}', f'{3.14159:.2f}', f'{5:03d}', f'{"x":>5}', f'{"x"!r}', f'{1=}', f'{ 1 + 1 = }', f'{[1, 2][0]}', f'{ {"a": 1}["a"]}'
f'{3.14159:{5}.{2}}', f'{"a" if 1 else "b"}', f'{(lambda x: x * 2)(4)}', f'a' 'b{c}' f'{1}', rf'\d{1}', f'{1,2}', f'{1!=2}', f"{'a':*^5}"
f'{}'
f'{1'
f'}'
f'{1!z}'
'%d' % 3, '%d' % 3.99, '%s' % 'a', '%s %s' % (1, 'b'), '%f' % 1, '%.3f' % 3.14159, '%5.2f|' % 3.14159, '%-8s|' % 'ab', '%08.3f' % -3.14159
'%x %X %o' % (255, 255, 8), '%#x %#o' % (255, 8), '%e' % 12345.678, '%E' % 0.00012, '%g %g %g' % (1e10, 0.0001, 123456789), '%G' % 1e-10
'%r %r' % ('a', 1.0), '%%', '%5d|%-5d|%05d' % (42, 42, 42), '%+d % d' % (5, 5), '%c%c' % ('a', 98), '%(a)s-%(b)d' % {'a': 1, 'b': 2}, '%*d' % (5, 42), '%.*f' % (2, 3.14159)
'%s' % [1, 2], '%s' % None, '%s' % {'a': 1}, '%s' % (('a', 1),), '%.2s' % 'abc', '%i' % 7, '%.0f' % 2.5, '%.0f' % 3.5, '%5s%%' % 50, '%.3d' % 5, '%+.1e' % 0
'%a' % 'é', '%#.0f' % 3, '%#g' % 1.0, '%f' % inf, '%5.1f' % nan, '%d' % True, '%s' % True, '%-+6d|' % 3
'%d' % 'a'
'%s %s' % 1
'%s' % (1, 2)
'abc' % 1
'abc' % [1], 'abc' % {}
'%y' % 1
'%' % 1
'%(a)s' % 1
'%x' % 1.5
'{} {}'.format(1, 2), '{1} {0}'.format('a', 'b'), '{a}-{b}'.format(a=1, b=2), '{0[0]} {0[1]}'.format([1, 2]), '{0[a]}'.format({'a': 5}), '{:5}|{:<5}|{:>5}|{:^5}|'.format(1, 2, 3, 4)
'{:.2f} {:8.3f} {:+} {: } {:e} {:g} {:%}'.format(1.005, 3.14159, 5, 5, 12345.6789, 1e-7, 0.256), '{:08.2f}'.format(-3.14159), '{:,}'.format(1234567), '{:_}'.format(1234567), '{:,.2f}'.format(1234567.891)
'{:x} {:X} {:o} {:b} {:#x} {:#b} {:c}'.format(255, 255, 8, 5, 255, 5, 65), '{:s}'.format('a'), '{!r:>6}'.format('a'), '{:{}}'.format('a', 5), '{:{w}.{p}f}'.format(3.14159, w=8, p=2)
'{:*^9}'.format('mid'), '{:05}'.format(42), '{:05}'.format(-42), '{:<05}'.format(42), '{:=+6}'.format(42), '{:015,d}'.format(1234567), '{:010,}'.format(1234), '{:.3}'.format('abcdef'), '{:05}'.format('ab')
'{:.3}'.format(3.14159), '{:.3}'.format(1234.5), '{:.1}'.format(100.0), '{:.10}'.format(1.0), '{:10}'.format(1.5), '{:}'.format(1.0), '{:n}'.format(5), '{:_x}'.format(1234567), '{:.0%}'.format(0.5), '{:z.1f}'.format(-0.01)
'{:>10}'.format(True), '{:d}'.format(True), '{}'.format(True), '{:5}'.format(False), '{}'.format(None), '{}'.format([1, 'a']), '{:.2f}'.format(1), '{:e}'.format(0.0), '{:F}'.format(inf), '{:06.1f}'.format(inf), '{:#.0f}'.format(1.0)
'{{}}'.format(), '{{{}}}'.format(1), '{0}{0}'.format('ab'), '{:%d}'
'{:#o} {:#X} {:+x} {:08b} {:#010b}'.format(8, 255, 10, 5, 5), '{:.0f} {:.0f} {:.0f}'.format(0.5, 1.5, 2.5), '{:G} {:E}'.format(1e20, 1.5)
'{:d}'.format(1.5)
'{:d}'.format('a')
'{:.2}'.format(1)
'{:>5}'.format([1])
'{:5}'.format(None)
'{} {1}'.format(1, 2)
'{}'.format()
'{a}'.format()
'{'.format()
'}'.format()
'{:q}'.format(1)
'{0.real}'.format('a')
'a,b,c'.split(','), 'a b  c '.split(), ' a '.split(), ''.split(), 'abc'.split('b'), 'a,b,c'.split(',', 1), ','.split(','), 'a b c'.split(None, 1), 'a--b'.split('--'), ''.split(','), ' a  b '.split(maxsplit=1)
'a,b,c'.rsplit(',', 1), 'a b c '.rsplit(None, 1), 'a b'.rsplit(), 'a b c'.rsplit(' ', 5)
'a'.split('')
','.join(['a', 'b']), ''.join('abc'), '-'.join(('x',)), ' '.join([]), ', '.join(str(i) for i in range(3)), '/'.join(map(str, [1, 2]))
','.join([1])
'  a '.strip(), '  a '.lstrip() + '|', '  a '.rstrip(), 'xxaxx'.strip('x'), 'abcba'.strip('ab'), '/a/'.rstrip('/'), 'a'.strip('')
'aXbX'.replace('X', '-'), 'aaa'.replace('a', 'b', 2), 'abc'.replace('', '-'), 'abc'.replace('', '-', 2), 'a'.replace('x', 'y'), ''.replace('', 'x')
'abc'.startswith('ab'), 'abc'.endswith('bc'), 'abc'.startswith(('x', 'a')), 'abc'.startswith('b', 1), 'abc'.endswith('b', 0, 2), 'abc'.startswith(''), 'abc'.startswith('', 5)
'AbC'.lower(), 'AbC'.upper(), 'hello world'.title(), "they're".title(), 'hELLO'.capitalize(), 'aBc'.swapcase(), 'straße'.upper(), 'x1y'.title()
'hello'.find('l'), 'hello'.rfind('l'), 'hello'.find('x'), 'hello'.index('e'), 'hello'.rindex('l'), 'hello'.count('l'), 'hello'.find('l', 3), 'hello'.find('l', -1), 'hello'.count(''), 'aaaa'.count('aa'), 'häl'.find('l'), 'hello'.find('', 5), 'hello'.find('', 6)
'hello'.index('x')
'5'.zfill(3), '-5'.zfill(4), '+5'.zfill(4), 'abc'.zfill(2), 'a'.center(4), 'ab'.center(5), 'a'.center(4, '*'), 'a'.ljust(3) + '|', 'a'.rjust(3), 'a'.rjust(3, '0'), 'abc'.center(2)
'12'.isdigit(), ''.isdigit(), 'ab'.isalpha(), 'a1'.isalnum(), ' \t'.isspace(), 'AB'.isupper(), 'ab1'.islower(), '1'.isupper(), 'a_b'.isidentifier(), '1a'.isidentifier(), '12'.isnumeric(), '12'.isdecimal()
'a=b=c'.partition('='), 'a=b=c'.rpartition('='), 'abc'.partition('x'), 'abc'.rpartition('x'), 'a\nb\r\nc'.splitlines(), 'a\n'.splitlines(), 'a\nb'.splitlines(True), 'prefix_x'.removeprefix('prefix_'), 'x_s'.removesuffix('_s')
'abc'.foo
'abc'.append('d')
(1).foo
[1, 2, 1].index(2), [1, 2, 1].count(1), (1, 2).index(1), (1, 1).count(1), [1, 2].copy()
[1].index(3)
{'a': 1, 'b': 2}.keys(), {'a': 1}.values(), {'a': 1}.items(), list({'a': 1, 'b': 2}), {'a': 1}.get('a'), {'a': 1}.get('b'), {'a': 1}.get('b', 5), len({'a': 1}), list({'a': 1}.items())
dict(a=1, b=2), dict([('a', 1), ['b', 2]]), dict({'a': 1}, b=2), dict(), dict({'a': 1}, a=3), {**{'a': 1}, 'b': 2}, {'a': 1, 'a': 2}, {1: 'a', 1.0: 'b', True: 'c'}, {'a': 1} | {'b': 2}, dict(zip('ab', [1, 2]))
('a' in {'a': 1}.keys()), (1 in {'a': 1}.values()), (('a', 1) in {'a': 1}.items())
[x * 2 for x in range(4)], [x for x in range(10) if x % 2], [x for x in range(20) if x % 2 if x % 3], [(x, y) for x in range(2) for y in range(x, 3)], [[y for y in range(x)] for x in range(3)], {x: x * x for x in range(3)}, {x % 1 for x in range(3)}
[a + b for a, b in [(1, 2), (3, 4)]], [a for a, (b, c) in [(1, (2, 3))]], [k + str(v) for k, v in {'a': 1}.items()], [x for x in 'abc'], [x for x, in [(1,), (2,)]], list(x for x in [1, 2]), sum(x for x in range(5)), [i for i in [1, 2] for i in [i * 10, i * 20]]
[x for x in 5]
[a for a, b in [1]]
[a for a, b in [(1, 2, 3)]]
[y for x in y]
(lambda: 5)(), (lambda x: x + 1)(2), (lambda x, y=2: x * y)(3), (lambda x, y=2: x * y)(3, y=5), (lambda *a: a)(1, 2), (lambda **k: k)(a=1), (lambda x, *a, y=1, **k: (x, a, y, k))(1, 2, 3, y=4, z=5), (lambda x: lambda y: x + y)(1)(2)
(lambda f, n: f(f, n))(lambda f, n: 1 if n < 2 else n * f(f, n - 1), 10)
(lambda x: x)()
(lambda x: x)(1, 2)
(lambda x: x)(y=1)
(lambda x: x)(1, x=1)
max(1, 2, 3), min(1, 2), max([1, 5, 3]), min('abc'), max([], default=0), max('ab', 'c', key=len), min([3, 1, 2], key=lambda x: -x), max(1, 1.0), max(1.0, 1), min((1, 2), (1, 1)), max(True, 0)
max([])
max(1, 'a')
max(1)
max()
len('abc'), len([]), len((1, 2)), len({'a': 1}), len('äö'), len(range(10)), len({1, 2, 2})
len(5)
abs(-5), abs(-5.5), abs(True), abs(-0.0)
abs('a')
round(2.5), round(3.5), round(-2.5), round(2.675, 2), round(2.5, 0), round(1234.5, -2), round(1250, -2), round(1350, -2), round(5), round(5, 2), round(-0.4), round(1e20), round(0.5), round(1.5), round(2.345678, 3), round(True), round(15, -1), round(25, -1), round(-15, -1), round(1e300, -299), round(5.5e15, -16), round(49.9, -2), round(50.0, -2), round(50.1, -2), round(7, -5), round(2.5, None), round(number=1.26, ndigits=1)
round(inf)
round(nan)
round('a')
round(1.5, 0.5)
int('12'), int(' 12 '), int('-5'), int('+5'), int('1_000'), int(3.99), int(-3.99), int(True), int('ff', 16), int('0xff', 16), int('0xff', 0), int('101', 2), int('0b101', 0), int(), int('z', 36), int('007'), int('0', 0), int(1e18), int('10', base=8)
int('1.5')
int('')
int('a')
int('1__0')
int('_1')
int('0x')
int('08', 0)
int(None)
int(inf)
int(nan)
int(1, 2)
int('1', 1)
float('1.5'), float(' 1e3 '), float('inf'), float('-Infinity'), float('nan'), float(3), float(True), float('1_0.5'), float('.5'), float('5.'), float(), float('1E-5'), float('+1'), float('00012')
float('')
float('a')
float('1e')
float('.')
float('1__0')
float([])
str(1.0), str(True), str(None), str('a'), str([1, 'a']), str(), str(1e16), str((1,)), str({'a': (1, 2.5)}), str({1}), str(set())
bool(0), bool('a'), bool(''), bool([]), bool(0.0), bool(nan), bool(None), bool()
list('abc'), list((1, 2)), list(range(3)), tuple([1, 2]), list({'a': 1}), set([1]), list(), tuple(), len(set('aab')), frozenset([1]) == {1}, list(map(str, [1, 2])), tuple('ab')
list(5)
list(1, 2)
sum([1, 2, 3]), sum([0.1] * 10), sum([1, 2], 10), sum([]), sum([[1], [2]], []), sum((x for x in (1.5, 2)), start=1), sum([True, True])
sum(['a'])
sum(['a'], '')
sorted([3, 1, 2]), sorted('bca'), sorted([3, 1, 2], reverse=True), sorted(['bb', 'a', 'ccc'], key=len), sorted([(1, 'b'), (1, 'a')]), sorted({'b': 1, 'a': 2}), sorted([(2, 'a'), (1, 'b'), (2, 'c'), (1, 'd')], key=lambda p: p[0], reverse=True), sorted([1, True, 0, False])
sorted([1, 'a'])
sorted(1)
list(zip([1, 2, 3], 'ab')), list(zip()), list(enumerate('ab')), list(enumerate('ab', 1)), list(enumerate('ab', start=5)), list(reversed([1, 2, 3])), list(reversed('abc')), list(reversed(range(0, 10, 3))), list(filter(None, [0, 1, '', 'a'])), list(filter(lambda x: x > 1, [1, 2, 3])), list(map(lambda a, b: a + b, [1, 2], [3, 4, 5])), list(map(abs, [-1, 2]))
any([0, 1]), any([]), all([1, 0]), all([]), any(x > 2 for x in range(5)), any(1 / x for x in [1, 0]), all(x for x in [0, 1 / 1])
all(1 / x for x in [1, 0])
divmod(7, 2), divmod(-7, 2), divmod(7.5, 2), divmod(-7, 2.0), divmod(True, 2)
ord('a'), chr(97), hex(255), oct(8), bin(5), hex(-255), repr('a'), repr(1.0), ascii('é'), isinstance(1, int), isinstance(True, int), isinstance(1, float), isinstance('a', (int, str)), isinstance([], list), isinstance({}, dict)
type(1), type('a'), type(1.0), type([]), type(True), int, str, type(1) == int, type({}) is dict, type(()) == tuple
ord('ab')
isinstance(1, 1)
pi, e, tau, inf, nan, sin(pi), cos(pi), tan(pi / 4), sqrt(2), sin(pi/6), cos(radians(60)), degrees(1), radians(90), atan2(1, -1), atan2(-0.0, -1), hypot(3, 4), hypot(1, 1), hypot(1, 2, 3), hypot(), exp(1), log(10), log(8, 2), log10(1000), log2(8), log1p(1e-10), expm1(1e-10), pow(2, 3), pow(2, 0.5), fabs(-3), floor(-2.5), ceil(-2.5), trunc(-2.5), floor(3), fmod(-7, 3), copysign(1, -0.0)
asin(1), acos(0), atan(1), sinh(1), cosh(1), tanh(1), asinh(1), acosh(2), atanh(0.5), exp2(10), factorial(10), factorial(0), gcd(12, 18), gcd(), gcd(-4, 6), lcm(4, 6), lcm(), comb(5, 2), comb(3, 5), perm(5, 2), perm(5), isqrt(17), modf(3.25), modf(-3.25), modf(inf), frexp(8), frexp(0), ldexp(0.5, 4), ldexp(1, -2000), fsum([0.1] * 10), prod([1, 2, 3]), prod([]), prod([2], start=5), dist([0, 0], [3, 4]), isclose(1, 1 + 1e-10), isclose(1, 1.1), isclose(1, 1.1, rel_tol=0.2), isclose(0, 1e-10, abs_tol=1e-9), isfinite(1), isinf(inf), isnan(nan), remainder(5, 3), remainder(7, 2), nextafter(1, 2), ulp(1), erf(0.5), erfc(0.5), gamma(5), fsum([1e100, 1, -1e100]), fsum([1e16, 1, 1e-16]), pow(0, 0), pow(inf, 0), pow(1, nan)
comb(100, 30), comb(120, 3), perm(20, 10), factorial(33), isqrt(10**30), lcm(10**10, 10**12 + 1), gcd(2**90, 6**20)
sqrt(-1)
log(0)
log(-1)
log(1, 1)
acos(2)
exp(1000)
sin('a')
sin()
sin(1, 2)
sin(inf)
factorial(-1)
factorial(1.5)
fmod(1, 0)
pow(0, -1)
pow(-8, 1/3)
gamma(0)
gamma(-1)
atanh(1)
floor(inf)
floor('a')
comb(-1, 2)
isqrt(-1)
ldexp(1, 5000)
dist([1], [1, 2])
cosh(1000)
undefined_name
undefined_function(1)
sin.foo
5()
'a'()
[1, 2,][0], (1, 2,), {'a': 1,}['a'], max(1, 2,), (1), (1,), (), [], {}, {1,}
[*range(3)], [*'ab', 1], (*[1], 2), {*[1]}, max(*[1, 2]), dict(**{'a': 1}), max(*[1], *[3]), {**{}, **{'a': 1}}
1 +
1 + + 2, 1 - -2, - - 3, ~-1, -2 ** 2, 2 ** -1, 2 ** 3 ** 2, (2 ** 3) ** 2, not not 1, not 1 == 2
(1
1)
[1
1 2
a b
1 = 2
x := 5
lambda
if x
for x in y
1 if 2
[x for x]
[for x in y]
{1: 2, 3}
{1, 2: 3}
f(x for x in [1], 2)
max(key=len, 'a')
max(a=1, a=2)
'abc
"abc'
'''abc'
1 <> 2
a && b
a || b
!a
$x
a ? b : c
1;2
import math
1 if 1 else
not
in
1 not 2
1 is in 2
*[1]
**{}
f(**1)
f(*1)
"""

HAND_PICKED_WITH_BREAKS = ["(1 +\n 2)", "[1,\n2]", "\n1", "1\n", "  1  ", "1 +\\\n2", "1 # comment", "(1 # comment\n+ 2)", "1\n2", "1 +\n2", "'a\tb'", "['a\\tb']"]


class Generator:
    """Random expressions, mostly valid ones."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def pick(self, *choices):
        return self.random.choice(choices)

    def integer(self):
        return str(self.pick(0, 1, 2, 3, 5, 7, 10, 12, 100, 255, 1000, 4096, 10**6, 2**31, 2**53, 2**63, self.random.randrange(10**4)))

    def real(self):
        kind = self.random.randrange(6)
        if kind == 0:
            return repr(self.random.uniform(-10, 10))
        if kind == 1:
            return repr(self.random.uniform(0, 1) * 10.0 ** self.random.randrange(-20, 25))
        if kind == 2:
            return repr(round(self.random.uniform(0, 5), self.random.randrange(4)))
        return self.pick("0.5", "0.1", "1.0", "2.5", "-0.0", "1e-3", "pi", "1e16", "0.035", "3.14159", "1e-5", "inf")

    def number(self, depth):
        if depth <= 0 or self.random.random() < 0.2:
            return self.pick(self.integer, self.real, self.real)()
        kind = self.random.randrange(16)
        inner = depth - 1
        if kind < 7:
            operator = self.pick("+", "-", "*", "/", "//", "%", "+", "-", "*", "/")
            return f"{self.number(inner)} {operator} {self.number(inner)}"
        if kind == 7:
            return f"({self.number(inner)})"
        if kind == 8:
            return f"-{self.number(inner)}" if self.random.random() < 0.7 else f"~({self.number(inner)})"
        if kind == 9:
            return f"({self.number(inner)}) ** {self.pick('2', '3', '0.5', '-1', '0', '-2')}"
        if kind == 10:
            function = self.pick("sin", "cos", "tan", "sqrt", "abs", "floor", "ceil", "round", "int", "float", "radians", "degrees", "exp", "atan", "fabs", "log", "tanh", "asin", "cosh", "trunc", "log10", "log2")
            return f"{function}({self.number(inner)})"
        if kind == 11:
            return f"{self.pick('max', 'min', 'atan2', 'hypot', 'fmod', 'copysign', 'divmod')}({self.number(inner)}, {self.number(inner)})"
        if kind == 12:
            return f"round({self.number(inner)}, {self.pick('0', '1', '2', '3', '5', '-1', '-2')})"
        if kind == 13:
            return f"({self.number(inner)} if {self.condition(inner)} else {self.number(inner)})"
        if kind == 14:
            return f"{self.pick('len', 'sum', 'max', 'min')}({self.listing(inner)})"
        return f"({self.integer()} {self.pick('&', '|', '^', '<<', '>>')} {self.pick('1', '3', '5', '8')})"

    def condition(self, depth):
        kind = self.random.randrange(7)
        inner = depth - 1
        if depth <= 0 or kind == 0:
            return self.pick("True", "False", "1", "0", "''", "None")
        if kind < 3:
            return f"{self.number(inner)} {self.pick('<', '<=', '>', '>=', '==', '!=')} {self.number(inner)}"
        if kind == 3:
            return f"{self.condition(inner)} {self.pick('and', 'or')} {self.condition(inner)}"
        if kind == 4:
            return f"not {self.condition(inner)}"
        if kind == 5:
            return f"{self.text(inner)} {self.pick('==', '!=', 'in', 'not in', '<')} {self.text(inner)}"
        return f"{self.number(inner)} {self.pick('in', 'not in')} {self.listing(inner)}"

    def text(self, depth):
        inner = depth - 1
        if depth <= 0 or self.random.random() < 0.2:
            return self.pick("'left'", "'front_wheel'", "''", "'a b c'", "'Über'", "\"it's\"", "'1.5'", "'x,y'", "'a\\nb'", "'%s'", "'0 0 1'")
        kind = self.random.randrange(9)
        if kind == 0:
            return f"{self.text(inner)} + {self.text(inner)}"
        if kind == 1:
            return f"str({self.anything(inner)})"
        if kind == 2:
            method = self.pick("lower", "upper", "title", "strip", "capitalize", "swapcase")
            return f"({self.text(inner)}).{method}()"
        if kind == 3:
            bound = lambda: self.pick("", "0", "1", "-1", "2", "-3", "10")
            return f"({self.text(inner)})[{bound()}:{bound()}{self.pick('', ':2', ':-1', ':1')}]"
        if kind == 4:
            specification = self.pick("%d", "%5.2f", "%s", "%g", "%x", "%e", "%08.3f", "%-6d|", "%+.3g", "%r", "%i", "%.10g", "%.0f", "%#x")
            return f"'{specification}' % ({self.number(inner)})"
        if kind == 5:
            specification = self.pick("", ":.3f", ":>8", ":08.2f", ":g", ":e", ":+.1f", ":,", ":.2%", "!r", ":^9", ":.4", ":12.5g", ":_.2f", ":<7", ":#g", ":.0e", ":015,.2f", ":=+9", ":d")
            return f"'{{{specification}}}'.format({self.number(inner)})"
        if kind == 6:
            return f"({self.text(inner)}) * {self.pick('0', '2', '-1', '3')}"
        if kind == 7:
            return f"{self.text(inner)}.replace({self.pick(repr('a'), repr(' '), repr(''))}, {self.pick(repr('_'), repr(''))})"
        return f"','.join(str(x) for x in {self.listing(inner)})"

    def listing(self, depth):
        inner = depth - 1
        kind = self.random.randrange(8)
        if depth <= 0 or kind == 0:
            return self.pick("[1, 2, 3]", "[]", "(0.5, 1)", "range(4)", "[3, 1, 2]", "(1,)", "range(10, 0, -3)")
        if kind == 1:
            return f"[{self.number(inner)}, {self.number(inner)}]"
        if kind == 2:
            return f"[x * {self.number(inner)} for x in {self.listing(inner)}]"
        if kind == 3:
            return f"[x for x in {self.listing(inner)} if x > {self.number(inner)}]"
        if kind == 4:
            return f"sorted({self.listing(inner)})"
        if kind == 5:
            return f"list({self.listing(inner)})[{self.pick('::-1', '1:', ':-1', '::2')}]"
        if kind == 6:
            return f"list(map(lambda x: {self.pick('x + 1', 'x / 2', 'x ** 2', '-x', 'str(x)', '(x, x)')}, {self.listing(inner)}))"
        return f"list(enumerate({self.listing(inner)}))"

    def anything(self, depth):
        return self.pick(self.number, self.number, self.text, self.listing, self.condition)(depth)


def escaped(text):
    return text.replace("\\", "\\\\").replace("\t", "\\t").replace("\n", "\\n").replace("\r", "\\r")


def outcome(expression):
    try:
        value = eval(compile(expression.strip(), "expression", "eval"), dict(NAMES))
        if isinstance(value, complex):
            return "!complex"
        text = str(value)
    except Exception as exception:
        return "!" + type(exception).__name__
    # Addresses say nothing.
    if " at 0x" in text or "built-in" in text or "j)" in text:
        return None
    return "=" + text


def expressions():
    pending = ""
    for line in HAND_PICKED.strip("\n").split("\n"):
        pending = pending + "\n" + line if pending else line
        # Triple quotes and escaped line breaks go on.
        if pending.count("'''") % 2 and pending != "'''abc'" or pending.endswith("\\"):
            continue
        yield pending
        # Each part of a tuple alone, so that a failure names it.
        pending = ""
    yield from HAND_PICKED_WITH_BREAKS
    generator = Generator(20)
    for index in range(2600):
        yield generator.anything(1 + index % 4)


def passes_128_bits(expression):
    """Whether a part of the expression is an integer that Periplus refuses."""
    try:
        tree = ast.parse(expression.strip(), mode="eval")
    except SyntaxError:
        return False
    for node in ast.walk(tree.body):
        try:
            value = eval(compile(ast.Expression(node), "part", "eval"), dict(NAMES))
        except Exception:
            continue
        if isinstance(value, int) and abs(value) >= 2**127:
            return True
    return False


def main():
    assert sys.version_info[:2] == (3, 11), "the table is Python 3.11's"
    warnings.simplefilter("ignore")
    seen = set()
    for expression in expressions():
        parts = [expression]
        try:
            tree = ast.parse(expression.strip(), mode="eval").body
            if isinstance(tree, ast.Tuple) and not expression.strip().startswith("("):
                parts = [ast.get_source_segment(expression.strip(), part) for part in tree.elts]
        except SyntaxError:
            pass
        for part in parts:
            if part in seen or len(part) > 300:
                continue
            seen.add(part)
            if not passes_128_bits(part) and (result := outcome(part)) is not None:
                print(escaped(part), escaped(result), sep="\t")


if __name__ == "__main__":
    main()
