// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Steps of Runge-Kutta pairs of Dormand and Prince on fixed-size vectors, for autonomous right-hand sides.

The coefficients are those published by E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary
Differential Equations I (2nd ed. 1993), Sec. II.5: Table 5.2 for order 5(4), the program's of Sec. II.10 for 8(5,3). */
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace tautline {

/** The pair of order 8(5,3): where an arc of a radian has many digits in one step.

Either pair's step goes from y over h. A stage waits for the slope before it alone: what that adds comes last.
@param derivative   callable: void(const State& y, State& dydx)
@param k1           derivative at y
@param weights      1 over the size that counts as 1 for each component
@param yNew         result
@return the pair's error estimate, in the root mean square of the weighted components; not finite if a slope is not */
struct DormandPrince853 {
    /** By which factor a step may grow for its error to grow by `errorRatio`; three roots are quicker than a power. */
    static double calcStepRatio(double errorRatio) { return std::sqrt(std::sqrt(std::sqrt(errorRatio))); }

    /** About two thirds of the angle that the pair gets through on a sphere, 6.6 accuracy^(1/8). */
    static double calcFirstAngle(double accuracy) { return std::min(4 * calcStepRatio(accuracy), 2.0); }

    template <int n, class Derivative>
    static double step(const Derivative& derivative, const Eigen::Matrix<double, n, 1>& y,
                       const Eigen::Matrix<double, n, 1>& k1, double h, const Eigen::Matrix<double, n, 1>& weights,
                       Eigen::Matrix<double, n, 1>& yNew);
};

/** The pair of order 5(4): half the work of a step, if few digits are asked for. */
struct DormandPrince54 {
    static double calcStepRatio(double errorRatio) { return std::pow(errorRatio, 0.2); }

    /** The angle on a sphere is 3.8 accuracy^(1/5), 0.6 for 1e-4 and 0.9 for 1e-3; a smaller one, without a power,
     * serves as well.
     */
    static double calcFirstAngle(double accuracy) { return std::min(4 * std::sqrt(std::sqrt(accuracy)), 1.0); }

    template <int n, class Derivative>
    static double step(const Derivative& derivative, const Eigen::Matrix<double, n, 1>& y,
                       const Eigen::Matrix<double, n, 1>& k1, double h, const Eigen::Matrix<double, n, 1>& weights,
                       Eigen::Matrix<double, n, 1>& yNew);
};

template <int n, class Derivative>
double DormandPrince853::step(const Derivative& derivative, const Eigen::Matrix<double, n, 1>& y,
                              const Eigen::Matrix<double, n, 1>& k1, double h,
                              const Eigen::Matrix<double, n, 1>& weights, Eigen::Matrix<double, n, 1>& yNew) {
    using State = Eigen::Matrix<double, n, 1>;
    State at, k2, k3, k4, k5, k6, k7, k8, k9, k10, k11, k12, error5, error3;
    const auto stage = [&](auto sum, double lastWeight, const State& last, State& k) {
        const double hLast = h * lastWeight;
        for (int i = 0; i < n; ++i) at[i] = (y[i] + h * sum(i)) + hLast * last[i];
        derivative(at, k);
    };
    stage([&](int) { return 0.0; }, 5.26001519587677318785587544488e-2, k1, k2);
    stage([&](int i) { return 1.97250569845378994544595329183e-2 * k1[i]; }, 5.91751709536136983633785987549e-2, k2,
          k3);
    stage([&](int i) { return 2.95875854768068491816892993775e-2 * k1[i]; }, 8.87627564304205475450678981324e-2, k3,
          k4);
    stage(
        [&](int i) { return 2.41365134159266685502369798665e-1 * k1[i] - 8.84549479328286085344864962717e-1 * k3[i]; },
        9.24834003261792003115737966543e-1, k4, k5);
    stage([&](int i) { return 3.7037037037037037037037037037e-2 * k1[i] + 1.70828608729473871279604482173e-1 * k4[i]; },
          1.25467687566822425016691814123e-1, k5, k6);
    stage(
        [&](int i) {
            return 3.7109375e-2 * k1[i] + 1.70252211019544039314978060272e-1 * k4[i] +
                   6.02165389804559606850219397283e-2 * k5[i];
        },
        -1.7578125e-2, k6, k7);
    stage(
        [&](int i) {
            return 3.70920001185047927108779319836e-2 * k1[i] + 1.70383925712239993810214054705e-1 * k4[i] +
                   1.07262030446373284651809199168e-1 * k5[i] - 1.53194377486244017527936158236e-2 * k6[i];
        },
        8.27378916381402288758473766002e-3, k7, k8);
    stage(
        [&](int i) {
            return 6.24110958716075717114429577812e-1 * k1[i] - 3.36089262944694129406857109825e0 * k4[i] -
                   8.68219346841726006818189891453e-1 * k5[i] + 2.75920996994467083049415600797e1 * k6[i] +
                   2.01540675504778934086186788979e1 * k7[i];
        },
        -4.34898841810699588477366255144e1, k8, k9);
    stage(
        [&](int i) {
            return 4.77662536438264365890433908527e-1 * k1[i] - 2.48811461997166764192642586468e0 * k4[i] -
                   5.90290826836842996371446475743e-1 * k5[i] + 2.12300514481811942347288949897e1 * k6[i] +
                   1.52792336328824235832596922938e1 * k7[i] - 3.32882109689848629194453265587e1 * k8[i];
        },
        -2.03312017085086261358222928593e-2, k9, k10);
    stage(
        [&](int i) {
            return -9.3714243008598732571704021658e-1 * k1[i] + 5.18637242884406370830023853209e0 * k4[i] +
                   1.09143734899672957818500254654e0 * k5[i] - 8.14978701074692612513997267357e0 * k6[i] -
                   1.85200656599969598641566180701e1 * k7[i] + 2.27394870993505042818970056734e1 * k8[i] +
                   2.49360555267965238987089396762e0 * k9[i];
        },
        -3.0467644718982195003823669022e0, k10, k11);
    stage(
        [&](int i) {
            return 2.27331014751653820792359768449e0 * k1[i] - 1.05344954667372501984066689879e1 * k4[i] -
                   2.00087205822486249909675718444e0 * k5[i] - 1.79589318631187989172765950534e1 * k6[i] +
                   2.79488845294199600508499808837e1 * k7[i] - 2.85899827713502369474065508674e0 * k8[i] -
                   8.87285693353062954433549289258e0 * k9[i] + 1.23605671757943030647266201528e1 * k10[i];
        },
        6.43392746015763530355970484046e-1, k11, k12);
    for (int i = 0; i < n; ++i) {
        const double slope = 5.42937341165687622380535766363e-2 * k1[i] + 4.45031289275240888144113950566e0 * k6[i] +
                             1.89151789931450038304281599044e0 * k7[i] - 5.8012039600105847814672114227e0 * k8[i] +
                             3.1116436695781989440891606237e-1 * k9[i] - 1.52160949662516078556178806805e-1 * k10[i] +
                             2.01365400804030348374776537501e-1 * k11[i] + 4.47106157277725905176885569043e-2 * k12[i];
        error3[i] = h * (slope - 0.244094488188976377952755905512 * k1[i] - 0.733846688281611857341361741547 * k9[i] -
                         0.0220588235294117647058823529412 * k12[i]);
        error5[i] = h * (0.1312004499419488073250102996e-1 * k1[i] - 0.1225156446376204440720569753e1 * k6[i] -
                         0.4957589496572501915214079952 * k7[i] + 0.1664377182454986536961530415e1 * k8[i] -
                         0.3503288487499736816886487290 * k9[i] + 0.3341791187130174790297318841 * k10[i] +
                         0.8192320648511571246570742613e-1 * k11[i] - 0.2235530786388629525884427845e-1 * k12[i]);
        yNew[i] = y[i] + h * slope;
    }
    const double e5 = weights.cwiseProduct(error5).squaredNorm(), e3 = weights.cwiseProduct(error3).squaredNorm();
    return e5 > 0 ? e5 / std::sqrt((e5 + 0.01 * e3) * n) : e5;  // NaN stays NaN
}

template <int n, class Derivative>
double DormandPrince54::step(const Derivative& derivative, const Eigen::Matrix<double, n, 1>& y,
                             const Eigen::Matrix<double, n, 1>& k1, double h,
                             const Eigen::Matrix<double, n, 1>& weights, Eigen::Matrix<double, n, 1>& yNew) {
    using State = Eigen::Matrix<double, n, 1>;
    State at, k2, k3, k4, k5, k6, k7, error;
    const auto stage = [&](auto sum, double lastWeight, const State& last, State& k) {
        const double hLast = h * lastWeight;
        for (int i = 0; i < n; ++i) at[i] = (y[i] + h * sum(i)) + hLast * last[i];
        derivative(at, k);
    };
    stage([&](int) { return 0.0; }, 1.0 / 5, k1, k2);
    stage([&](int i) { return 3.0 / 40 * k1[i]; }, 9.0 / 40, k2, k3);
    stage([&](int i) { return 44.0 / 45 * k1[i] - 56.0 / 15 * k2[i]; }, 32.0 / 9, k3, k4);
    stage([&](int i) { return 19372.0 / 6561 * k1[i] - 25360.0 / 2187 * k2[i] + 64448.0 / 6561 * k3[i]; }, -212.0 / 729,
          k4, k5);
    stage(
        [&](int i) { return 9017.0 / 3168 * k1[i] - 355.0 / 33 * k2[i] + 46732.0 / 5247 * k3[i] + 49.0 / 176 * k4[i]; },
        -5103.0 / 18656, k5, k6);
    stage(
        [&](int i) { return 35.0 / 384 * k1[i] + 500.0 / 1113 * k3[i] + 125.0 / 192 * k4[i] - 2187.0 / 6784 * k5[i]; },
        11.0 / 84, k6, k7);
    yNew = at;
    for (int i = 0; i < n; ++i)
        error[i] = h * (71.0 / 57600 * k1[i] - 71.0 / 16695 * k3[i] + 71.0 / 1920 * k4[i] - 17253.0 / 339200 * k5[i] +
                        22.0 / 525 * k6[i] - 1.0 / 40 * k7[i]);
    return weights.cwiseProduct(error).norm() / std::sqrt(double(n));
}

}  // namespace tautline
