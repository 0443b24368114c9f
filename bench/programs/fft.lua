local pi, cos, sin, abs = math.pi, math.cos, math.sin, math.abs
local function bit_reverse(re, im, n)
  local j = 0
  for i = 0, n - 1 do
    if i < j then re[i], re[j], im[i], im[j] = re[j], re[i], im[j], im[i] end
    local m = n // 2
    while m >= 1 and j >= m do j = j - m; m = m // 2 end
    j = j + m
  end
end
local function fft(re, im, n, sign)
  bit_reverse(re, im, n)
  local half = 1
  while half < n do
    local angle = sign * pi / half
    local wr, wi, ur, ui = cos(angle), sin(angle), 1.0, 0.0
    for k = 0, half - 1 do
      for i = k, n - 1, half + half do
        local j = i + half
        local ar, ai, br, bi = re[i], im[i], re[j], im[j]
        local tr, ti = ur * br - ui * bi, ur * bi + ui * br
        re[j], im[j], re[i], im[i] = ar - tr, ai - ti, ar + tr, ai + ti
      end
      ur, ui = ur * wr - ui * wi, ur * wi + ui * wr
    end
    half = half * 2
  end
end
local function run(n)
  local re, im = {}, {}
  for i = 0, n - 1 do re[i], im[i] = 1.0 * (i * 7 % 31), 0.0 end
  fft(re, im, n, 1.0)
  local peak = 0.0
  for i = 0, n - 1 do local a = abs(re[i]); if a > peak then peak = a end end
  fft(re, im, n, -1.0)
  return peak + re[5] / n
end
local sum = 0.0
for i = 1, 24 do sum = sum + run(4096) end
print(string.format("%.0f", sum))
