% SPDX-License-Identifier: GPL-3.0-or-later
% GNU Octave on the reference six-bar, written as one would for a paper: reference-point coordinates,
% dense matrices, a reduction per right-hand side, Baumgarte's terms, ode45 or lsode. Units mm, mg, ms.
% Not part of the product. Two ways of building the matrices: a loop over the hinges, as a textbook has
% it ("loop"), and index vectors prepared once ("vectorised").
%
% octave-cli octave.m sixbar|rhs [--reference FILE] [--quick] [--only SETTING] [--from E] [--to E]
1;

function p = six_bar()
  p.m = [.0188 .0200 .0653 .0203 .0197];
  p.J = [.00286 .00344 .01155 .00360 .00330];
  p.centre = [.45 .775; .50 2.05; 1.50 2.875; 2.525 2.10; 2.575 .80];
  p.hinge = [.70 .15; .20 1.40; .80 2.70; 2.20 2.75; 2.85 1.45; 2.30 .15];
  p.k = [1.711 1.730 1.803 1.502 1.467 1.760]';
  p.c = [.0070 .0060 .0050 .0055 .0065 .0075]';
  p.M = diag(reshape([p.m; p.m; p.J], 15, 1));
  p.load = zeros(15, 1);
  p.load([7 8 3]) = [.35 -.20 -.15];
  p.q0 = reshape([p.centre zeros(5, 1)]', 15, 1);
  p.alpha = 10;
  p.beta = 10;
  % the loop: hinge j joins bodies j-1 and j; 0 and 6 are the ground
  for j = 1:6
    p.a(j) = j - 1;
    p.b(j) = mod(j, 6);
    p.sa(:, j) = zeros(2, 1);
    p.sb(:, j) = zeros(2, 1);
    if p.a(j), p.sa(:, j) = (p.hinge(j, :) - p.centre(p.a(j), :))'; end
    if p.b(j), p.sb(:, j) = (p.hinge(j, :) - p.centre(p.b(j), :))'; end
  end
  % prepared for the vectorised form: ten ends (hinge, body, sign)
  p.joint = [1:5 2:6];
  p.body = [1:5 1:5];
  p.sign = [-ones(1, 5) ones(1, 5)];
  p.local = [p.sb(:, 1:5) p.sa(:, 2:6)];
  p.G0 = zeros(12, 15);
  for i = 1:10
    r = 2 * p.joint(i) - 1;
    s = 3 * p.body(i) - 2;
    p.G0(r, s) = p.sign(i);
    p.G0(r + 1, s + 1) = p.sign(i);
    p.at(1, i) = sub2ind([12 15], r, s + 2);
    p.at(2, i) = sub2ind([12 15], r + 1, s + 2);
  end
  p.fixed = zeros(12, 1);
  p.fixed([1 2]) = p.hinge(1, :);
  p.fixed([11 12]) = -p.hinge(6, :);
  p.sum = zeros(6, 10);
  p.sum(sub2ind([6 10], p.joint, 1:10)) = 1;
  p.sum = kron(p.sum, eye(2));
  p.D = zeros(6, 15); % relative angles of the hinges
  for j = 1:6
    if p.a(j), p.D(j, 3 * p.a(j)) = -1; end
    if p.b(j), p.D(j, 3 * p.b(j)) = 1; end
  end
  p.K = p.D' * diag(p.k) * p.D;
  p.C = p.D' * diag(p.c) * p.D;
  % coordinate partitioning: the columns that a pivoted QR of the start picks are dependent
  [~, ~, order] = qr(jacobian_loop(p, p.q0, zeros(15, 1)), 0);
  p.dependent = order(1:12);
  p.independent = order(13:15);
end

function [G, Psi, gamma, Q] = jacobian_loop(p, q, v)
  G = zeros(12, 15);
  Psi = zeros(12, 1);
  gamma = zeros(12, 1);
  Q = p.load;
  for j = 1:6
    rows = 2 * j - 1:2 * j;
    angle = 0;
    rate = 0;
    a = p.a(j);
    if a
      i = 3 * a - 2;
      A = [cos(q(i + 2)) -sin(q(i + 2)); sin(q(i + 2)) cos(q(i + 2))];
      d = A * p.sa(:, j);
      G(rows, i:i + 2) = [eye(2) [-d(2); d(1)]];
      Psi(rows) = Psi(rows) + q(i:i + 1) + d;
      gamma(rows) = gamma(rows) + d * v(i + 2)^2;
      angle = angle - q(i + 2);
      rate = rate - v(i + 2);
    else
      Psi(rows) = Psi(rows) + p.hinge(j, :)';
    end
    b = p.b(j);
    if b
      k = 3 * b - 2;
      A = [cos(q(k + 2)) -sin(q(k + 2)); sin(q(k + 2)) cos(q(k + 2))];
      d = A * p.sb(:, j);
      G(rows, k:k + 2) = -[eye(2) [-d(2); d(1)]];
      Psi(rows) = Psi(rows) - q(k:k + 1) - d;
      gamma(rows) = gamma(rows) - d * v(k + 2)^2;
      angle = angle + q(k + 2);
      rate = rate + v(k + 2);
    else
      Psi(rows) = Psi(rows) - p.hinge(j, :)';
    end
    torque = p.k(j) * angle + p.c(j) * rate;
    if a, Q(i + 2) = Q(i + 2) + torque; end
    if b, Q(k + 2) = Q(k + 2) - torque; end
  end
end

function [G, Psi, gamma, Q] = jacobian_vectorised(p, q, v)
  phi = q(3 * p.body)';
  c = cos(phi) .* p.sign;
  s = sin(phi) .* p.sign;
  d = [c .* p.local(1, :) - s .* p.local(2, :); s .* p.local(1, :) + c .* p.local(2, :)];
  G = p.G0;
  G(p.at(1, :)) = -d(2, :);
  G(p.at(2, :)) = d(1, :);
  Psi = p.G0 * q + p.sum * d(:) + p.fixed;
  w = v(3 * p.body)';
  gamma = p.sum * reshape(d .* (w .* w), 20, 1);
  Q = p.load - p.K * q - p.C * v;
end

function y = rate(t, y, p, build, method)
  global rhs_count
  rhs_count++;
  q = y(1:15);
  v = y(16:30);
  [G, Psi, gamma, Q] = build(p, q, v);
  gamma = gamma - 2 * p.alpha * (G * v) - p.beta^2 * Psi;
  y = [v; method(p, G, gamma, Q)];
end

function a = kkt(p, G, gamma, Q)
  x = [p.M G'; G zeros(12)] \ [Q; gamma];
  a = x(1:15);
end

function a = svd_null_space(p, G, gamma, Q)
  [~, ~, W] = svd(G);
  N = W(:, 13:15);
  a = [G; N' * p.M] \ [gamma; N' * Q];
end

function a = coordinate_partitioning(p, G, gamma, Q)
  x = G(:, p.dependent) \ [G(:, p.independent) gamma];
  R = zeros(15, 3);
  R(p.dependent, :) = -x(:, 1:3);
  R(p.independent, :) = eye(3);
  g = zeros(15, 1);
  g(p.dependent) = x(:, 4);
  a = R * ((R' * p.M * R) \ (R' * (Q - p.M * g))) + g;
end

function a = udwadia_kalaba(p, G, gamma, Q)
  h = diag(1 ./ sqrt(diag(p.M)));
  free = p.M \ Q;
  a = free + h * pinv(G * h) * (gamma - G * free);
end

function reference = read_reference(path)
  table = load('-ascii', path); % lines with % or # are comments
  reference = table(1:10:101, 2:16);
end

function y = solve(name, f, y0, tolerance)
  t = 0:10;
  if strcmp(name, 'ode45')
    [~, y] = ode45(f, t, y0, odeset('RelTol', tolerance, 'AbsTol', tolerance));
  else
    lsode_options('integration method', name);
    lsode_options('relative tolerance', tolerance);
    lsode_options('absolute tolerance', tolerance);
    lsode_options('step limit', 1000000);
    y = lsode(@(y, t) f(t, y), y0, t);
  end
end

function yes = wanted(wish, setting, e)
  yes = (isempty(wish.only) || strcmp(wish.only, setting)) && e >= wish.from && e <= wish.to;
end

function curves(p, wish)
  global rhs_count
  reference = read_reference(wish.reference);
  y0 = [p.q0; zeros(15, 1)];
  settings = {'svd ode45 loop', @jacobian_loop, @svd_null_space, 'ode45';
              'svd ode45 vectorised', @jacobian_vectorised, @svd_null_space, 'ode45';
              'KKT ode45 vectorised', @jacobian_vectorised, @kkt, 'ode45';
              'coordinate partitioning ode45 vectorised', @jacobian_vectorised, @coordinate_partitioning, 'ode45';
              'Udwadia-Kalaba ode45 vectorised', @jacobian_vectorised, @udwadia_kalaba, 'ode45';
              'svd lsode adams loop', @jacobian_loop, @svd_null_space, 'adams';
              'KKT lsode adams vectorised', @jacobian_vectorised, @kkt, 'adams';
              'KKT lsode bdf vectorised', @jacobian_vectorised, @kkt, 'bdf'};
  tolerances = 4:11;
  if wish.quick, tolerances = 4:2:10; end
  for i = 1:rows(settings)
    f = @(t, y) rate(t, y, p, settings{i, 2}, settings{i, 3});
    f(0, y0);
    for e = tolerances
      if ~wanted(wish, settings{i, 1}, e), continue; end
      tolerance = 10^-e;
      cpu = [];
      do
        rhs_count = 0;
        began = cputime();
        y = solve(settings{i, 4}, f, y0, tolerance);
        cpu(end + 1) = cputime() - began;
      until sum(cpu) > .5 || numel(cpu) > 8
      worst = max(max(abs(y(2:11, 1:15) - reference(2:11, :))));
      printf('Octave,%s,%.3g,%.4e,%.7g,%d\n', settings{i, 1}, tolerance, worst, 1e3 * median(cpu), rhs_count);
    end
  end
end

function right_hand_sides(p)
  y0 = [p.q0 + .01 * (1:15)'; .1 * (1:15)'];
  builds = {'loop', @jacobian_loop; 'vectorised', @jacobian_vectorised};
  methods = {'svd', @svd_null_space; 'KKT', @kkt; 'coordinate partitioning', @coordinate_partitioning;
             'Udwadia-Kalaba', @udwadia_kalaba};
  for i = 1:2
    for j = 1:4
      for k = 1:5
        began = cputime();
        for n = 1:200, rate(0, y0, p, builds{i, 2}, methods{j, 2}); end
        cpu(k) = (cputime() - began) / 200;
      end
      printf('Octave,six-bar %s %s,0,nan,%.7g,1\n', methods{j, 1}, builds{i, 1}, 1e3 * median(cpu));
    end
  end
end

global rhs_count
rhs_count = 0;
arguments = argv();
wish = struct('reference', 'tests/data/sixbar_ref_0p1ms.txt', 'only', '', 'from', -99, 'to', 99, 'quick', false);
for i = 2:numel(arguments)
  switch arguments{i}
    case '--quick', wish.quick = true;
    case '--reference', wish.reference = arguments{i + 1};
    case '--only', wish.only = arguments{i + 1};
    case '--from', wish.from = str2double(arguments{i + 1});
    case '--to', wish.to = str2double(arguments{i + 1});
  end
end
if strcmp(arguments{1}, 'sixbar')
  curves(six_bar(), wish);
else
  right_hand_sides(six_bar());
end
