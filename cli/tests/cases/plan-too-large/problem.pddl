(define (problem large) (:domain carpets)
  (:objects t1 t2 t3 t4 t5 t6 t7 t8 t9 t10 t11 t12 t13 t14 t15 t16 t17 t18 t19 t20 t21 t22 t23 t24 t25 t26 t27 t28 t29 t30 t31 t32)
  (:init (plain t1) (plain t2) (plain t3) (plain t4) (plain t5) (plain t6) (plain t7) (plain t8) (plain t9) (plain t10) (plain t11) (plain t12) (plain t13) (plain t14) (plain t15) (plain t16) (plain t17) (plain t18) (plain t19) (plain t20) (plain t21) (plain t22) (plain t23) (plain t24) (plain t25) (plain t26) (plain t27) (plain t28) (plain t29) (plain t30) (plain t31) (plain t32) )
  (:goal (woven t1 t2 t3 t4 t5 t6)))
